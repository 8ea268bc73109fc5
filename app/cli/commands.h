// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/cli/cli_app.h"
#include "app/cli/line_files.h"
#include "app/cli/options.h"
#include "app/cli/viewer_window.h"
#include "app/session/outputs.h"
#include "app/session/progress.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct InfoArguments {
  std::string model;
  SettingArguments settings;
  std::string json;
  bool quiet = false;
};

void add_info_options(CLI::App& command, InfoArguments& arguments);
Result<CommandOutput> run_info(const InfoArguments& arguments, const Progress& progress = {});

struct ListArguments {
  std::string json;
};

/// Of `backends`, `models` and `devices`.
void add_list_options(CLI::App& command, ListArguments& arguments);

/// Name and description of the backends of this build, one a line, the default first.
Result<CommandOutput> run_backends(const ListArguments& arguments);

/// Name, number of faces and description of the bundled models, one a line.
Result<CommandOutput> run_models(const ListArguments& arguments);

/// What can draw on this machine, one a line, the default marked; what cannot says why. Errors:
/// kNoDevice when there is none at all, those of the JSON file.
Result<CommandOutput> run_devices(const ListArguments& arguments, Drawing& drawing);

/// The commands there are, in the order of the help.
std::vector<std::string> command_names(const CLI::App& root);

/// `shell`: bash, zsh or fish.
void add_completion_options(CLI::App& command, std::string& shell);

/// A script by which that shell completes the commands of `root`, their options, and the values of
/// settings.
Result<CommandOutput> run_completion(const std::string& shell, const CLI::App& root,
                                     std::span<const std::string> colour_maps);

struct GenerateArguments {
  std::string name;
  std::string faces;   ///< empty: the model's usual size
  std::string tets;    ///< of a volume; empty: some
  std::string frames;  ///< of a surface that waves; empty: it stands still
  std::string output;
  bool quiet = false;
};

void add_generate_options(CLI::App& command, GenerateArguments& arguments);
Result<CommandOutput> run_generate(const GenerateArguments& arguments,
                                   const Progress& progress = {});

/// A surface that moves.
struct SequenceArguments {
  std::string frames;     ///< Frames::open()'s path; empty: the model alone
  bool skip_bad = false;  ///< a frame that cannot be solved does not end the run
};

/// --sequence alone.
void add_sequence_option(CLI::App& command, std::string& frames);
void add_sequence_options(CLI::App& command, SequenceArguments& arguments);

struct SolveArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  std::vector<std::string> outputs;
  std::string json;
  CheckArguments check;
  std::string fields;        ///< quality fields beside the distances, empty: none
  std::string bake;          ///< the colour map that .ply files have colours of; empty: none
  bool labels = false;       ///< nearest sources in .csv and .npy, too
  bool each = false;         ///< a row of distances for each source
  bool pairs = false;        ///< distances between the sources alone
  bool symmetric = false;    ///< of pairs: the mean of both directions
  std::string max_distance;  ///< beyond it nothing is asked; empty: all is
  std::vector<std::string> targets;  ///< vertices, as sources are typed; none: all
  std::string dtype;                 ///< of .npy rows; empty: float64
  bool float32 = false;              ///< the same as --dtype float32
  SequenceArguments sequence;
  bool quiet = false;
};

void add_solve_options(CLI::App& command, SolveArguments& arguments);
/// --each, --pairs and what goes with them.
void add_many_options(CLI::App& command, SolveArguments& arguments);
/// What of a solve can be refused before its model is read, by its options of many sources and the
/// extensions of its outputs. Errors: kBadInput, kNotAvailable.
Result<void> check_solve(const SolveArguments& arguments);
/// `announce`: for what --each, --pairs and --sequence say before their work.
Result<CommandOutput> run_solve(const SolveArguments& arguments, const Drawing& drawing,
                                const Progress& progress = {}, const Announce& announce = {});

/// Whether it is one mesh over the ranks of a launcher (--backend petsc, or --method
/// wavefront as one of several), and its distances.
bool is_shared(const SolveArguments& arguments);
Result<CommandOutput> run_shared(const SolveArguments& arguments, const Progress& progress);

/// `solve --each`: one row of distances for each source, streamed into a .npy array of K x V.
Result<CommandOutput> run_each(const SolveArguments& arguments, const Progress& progress,
                               const Announce& announce);

/// `solve --pairs`: the distances between each two of K vertices.
Result<CommandOutput> run_pairs(const SolveArguments& arguments, const Progress& progress,
                                const Announce& announce);

/// `solve --sequence`: a row of distances for each frame into a .npy array, or a .vtp file for each
/// and the .pvd file that lists them.
Result<CommandOutput> run_sequence(const SolveArguments& arguments, const Progress& progress,
                                   const Announce& announce);

struct BatchArguments {
  std::vector<std::string> models;
  SolveArguments solve;             ///< what each of them is solved with
  std::vector<std::string> passed;  ///< the same as words
  std::string folder, format, jobs, json;
  bool quiet = false;
};

void add_batch_options(CLI::App& command, BatchArguments& arguments);

/// `batch`: a solve of each model, in processes of their own, shared out over ranks. Errors: those
/// of the options and of the folder; a model that cannot be solved is a line of the manifest, and
/// CommandOutput::failure.
Result<CommandOutput> run_batch(const BatchArguments& arguments, const Progress& progress = {});

struct PlanArguments {
  std::string vertices, sources, ranks, json;
};

void add_plan_options(CLI::App& command, PlanArguments& arguments);

/// Memory and time of a solve over ranks, by figures that were measured. Errors: those of the
/// options, kBadInput (more vertices than a process can hold).
Result<CommandOutput> run_plan(const PlanArguments& arguments);

/// Distances between K vertices, row by row: entry (i, j) is the distance at vertex j from a source
/// at vertex i. On a polyhedral surface it would be that of (j, i); by the heat method it is so but
/// for the discretisation error.
struct PairMatrix {
  std::vector<Index> vertices;
  std::vector<double> entries;  ///< K x K

  std::size_t size() const { return vertices.size(); }
  double at(std::size_t i, std::size_t j) const { return entries[i * size() + j]; }
};

/// How far the two directions are apart where both are finite.
struct Asymmetry {
  double most = 0;           ///< |d_ij - d_ji|, model units
  double of_larger = 0;      ///< the same for the most of |d_ij - d_ji| / max(d_ij, d_ji)
  std::size_t i = 0, j = 0;  ///< where `most` is
};
Asymmetry asymmetry(const PairMatrix& pairs);

/// Both directions become their mean.
void symmetrise(PairMatrix& pairs);

struct SampleArguments {
  std::string model;
  SettingArguments settings;
  std::string count;
  std::string first;                 ///< a vertex id; empty: chosen by the program
  std::string relax;                 ///< steps of Lloyd's iteration; empty: none
  std::vector<std::string> outputs;  ///< distances and labels of every vertex
  std::string samples;               ///< where the list of samples goes
  std::string json;
  CheckArguments check;
  bool quiet = false;
};

void add_sample_options(CLI::App& command, SampleArguments& arguments);
Result<CommandOutput> run_sample(const SampleArguments& arguments, const Progress& progress = {},
                                 const Announce& announce = {});

struct CompareArguments {
  std::vector<std::string> models;
  SettingArguments settings;
  std::string backends = "all";
  std::string queries = "10";
  std::string reference;  ///< empty: the first of the backends
  SourceArguments sources;
  std::string json, csv, html;
  bool quiet = false;
};

void add_compare_options(CLI::App& command, CompareArguments& arguments);
Result<CommandOutput> run_compare(const CompareArguments& arguments, const Progress& progress = {});

struct StudyArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  std::string factors = "0.1:100:13";
  std::string json, svg;
  bool quiet = false;
};

void add_study_options(CLI::App& command, StudyArguments& arguments);
Result<CommandOutput> run_study(const StudyArguments& arguments, const Progress& progress = {});

struct PathArguments {
  std::string model;
  SettingArguments settings;
  std::string from;
  std::vector<std::string> to, via;
  std::string pairs;    ///< a file with the points of many paths, in place of those
  std::string lengths;  ///< where a table of the lengths goes
  std::string field = "geodesic";
  bool closed = false, hold = false;
  LineFileArguments files;
  CheckArguments check;
  bool quiet = false;
};

void add_path_options(CLI::App& command, PathArguments& arguments);
Result<CommandOutput> run_path(const PathArguments& arguments, const Progress& progress = {});

struct LogMapArguments {
  std::string model;
  SettingArguments settings;
  std::string source;
  std::string max_distance;          ///< empty: all of the surface
  std::vector<std::string> targets;  ///< none: all vertices
  std::vector<std::string> outputs;
  std::string json;
  bool quiet = false;
};

void add_log_map_options(CLI::App& command, LogMapArguments& arguments);
Result<CommandOutput> run_log_map(const LogMapArguments& arguments, const Progress& progress = {});

struct TraceArguments {
  std::string model;
  SettingArguments settings;
  std::string from;
  std::vector<std::string> directions;  ///< radians
  std::string fan;                      ///< so many more, evenly spread; empty: none
  std::string length;
  LineFileArguments files;
  bool quiet = false;
};

void add_trace_options(CLI::App& command, TraceArguments& arguments);
Result<CommandOutput> run_trace(const TraceArguments& arguments, const Progress& progress = {});

struct CentreArguments {
  std::string model;
  SettingArguments settings;
  std::vector<std::string> of;
  std::string points, weights;  ///< a file, and numbers or a file; empty: none
  bool median = false;
  LineFileArguments files;
  bool quiet = false;
};

void add_centre_options(CLI::App& command, CentreArguments& arguments);
Result<CommandOutput> run_centre(const CentreArguments& arguments, const Progress& progress = {});

/// What `transport` and `extend` were given.
struct SpreadArguments {
  std::string model;
  SettingArguments settings;
  std::vector<std::string> given;  ///< V:X:Y of vectors, V:X of values
  std::string file;                ///< of more of them, one a line
  std::vector<std::string> outputs;
  std::string json;
  bool quiet = false;
};

void add_transport_options(CLI::App& command, SpreadArguments& arguments);
Result<CommandOutput> run_transport(const SpreadArguments& arguments,
                                    const Progress& progress = {});

void add_extend_options(CLI::App& command, SpreadArguments& arguments);
Result<CommandOutput> run_extend(const SpreadArguments& arguments, const Progress& progress = {});

struct SignedArguments {
  std::string model;
  SettingArguments settings;
  std::vector<std::string> through;
  bool closed = false;
  std::string curves, rule;  ///< empty: no file; auto
  std::vector<std::string> outputs;
  std::string json;
  bool quiet = false;
};

void add_signed_options(CLI::App& command, SignedArguments& arguments);
Result<CommandOutput> run_signed(const SignedArguments& arguments, const Progress& progress = {});

struct IsolinesArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  std::string spacing, count, values;  ///< one of them is given
  LineFileArguments files;
  CheckArguments check;
  bool quiet = false;
};

void add_isolines_options(CLI::App& command, IsolinesArguments& arguments);
Result<CommandOutput> run_isolines(const IsolinesArguments& arguments,
                                   const Progress& progress = {});

struct RenderArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  PictureArguments picture;
  CheckArguments check;
  SequenceArguments sequence;
  std::string max_distance;              ///< beyond it nothing is asked; empty: all is
  std::vector<std::string> targets;      ///< paths lead there from the sources
  std::vector<std::string> more_models;  ///< beside `model`
  std::string field;                     ///< a file of values of vertices; empty: distances
  std::string columns;                   ///< of several models; empty: as many as suit
  std::string fps;                       ///< of a film; empty: 25
  std::string output;
  std::string json;
  bool quiet = false;
};

void add_render_options(CLI::App& command, RenderArguments& arguments);

/// Pictures of a model, solved first where sources are given. Opens the device before it reads the
/// model; leaves no frame behind when one fails. Errors: those of the options, the drawing, the
/// solve and the files.
Result<CommandOutput> run_render(const RenderArguments& arguments, Drawing& drawing,
                                 const Progress& progress = {});

/// What was typed for a picture, as values.
struct AskedPicture {
  ViewerState state;
  PictureSettings settings;
  CheckSettings check;
};

/// `render --sequence`: a picture of each frame, all with one camera, which sees all frames, and
/// one scale. Errors: as above.
Result<CommandOutput> run_render_sequence(const RenderArguments& arguments,
                                          const AskedPicture& asked, Drawing& drawing,
                                          const Progress& progress);

struct ViewArguments {
  std::string model;
  SettingArguments settings = {.usual = initial_state()};
  SourceArguments sources;
  PictureArguments picture;
  std::string sequence;      ///< Frames::open()'s path; empty: the model alone
  std::string field;         ///< shown in place of distances; empty: these
  std::string max_distance;  ///< empty: all of the surface
  std::string script;        ///< commands to run, in the window or without
  std::string replay;        ///< commands to run without a window and without writing files
  std::string output;        ///< the picture at the end, without a window
  bool headless = false;
  std::string scale;
  bool validation = false;
  bool quiet = false;
};

void add_view_options(CLI::App& command, ViewArguments& arguments);

/// The commands that the options stand for. Errors: those of the options.
Result<std::vector<Command>> commands_of(const ViewArguments& arguments,
                                         std::span<const std::string> colour_maps);

/// Opens the window, or runs the commands without one where a replay, an output or --headless says
/// so. A session in the model's place is opened, or replayed. The output's text is then what the
/// session has to say.
Result<CommandOutput> run_view(const ViewArguments& arguments, Drawing& drawing,
                               ViewerWindow& window, const Progress& progress = {});

}  // namespace geotherm::app
