// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/cli_app.h"
#include "app/model_reading.h"
#include "app/outputs.h"
#include "app/source_spec.h"
#include "solver/core/result.h"
#include "solver/method/build_method.h"

namespace geotherm::app {

/// A method and its options as typed; the same in every command that solves.
struct MethodArguments {
  std::string backend;  ///< empty: the default one
  bool strict = false;
  std::string memory_limit = "free";
  std::string time_step = "mean-edge";
  std::string time_factor;  ///< empty: 1
  std::string constraint = "pin-sources";
  std::string heat = "unit";
  std::string method = "heat";
  std::string boundary = "neumann";
  std::string laplacian = "auto";
  std::string variant = "corrected";
  std::string precision = "compact";
  std::string refine = "0";
  std::string threads;  ///< empty: all cores
};

/// Where distance is 0, as typed.
struct SourceArguments {
  std::vector<std::string> sources;
  std::string file;
  bool curve = false;
};

void add_method_options(CLI::App& command, MethodArguments& arguments);
/// The model as a word of its own, and how it is read.
CLI::Option* add_model_option(CLI::App& command, std::string& model, ReadingArguments& reading);
void add_reading_options(CLI::App& command, ReadingArguments& reading);

/// Those of the heat method that a study does not sweep.
void add_study_method_options(CLI::App& command, MethodArguments& arguments);
void add_backend_option(CLI::App& command, MethodArguments& arguments);
void add_source_options(CLI::App& command, SourceArguments& arguments);
void add_threads_option(CLI::App& command, std::string& threads);
void add_quiet_option(CLI::App& command, bool& quiet);

/// Errors: kBadInput or kNotAvailable, with the option's name and the values there are.
Result<MethodOptions> method_options(const MethodArguments& arguments);

/// Says which of the options have no effect beside the others.
void note_unused_options(const MethodArguments& arguments, const MethodOptions& options,
                         std::vector<std::string>& warnings);

/// The files that these name, which no output may replace.
void protect_inputs(const std::string& model, const SourceArguments& sources, Outputs& outputs);

/// The sources of a command that cannot do without. Errors: those of sources_of(), kBadInput
/// (none).
Result<std::vector<Source>> some_sources_of(const SourceArguments& arguments);

/// All sources that were named; none is no error here. Errors: kBadInput, kBadFile.
Result<std::vector<Source>> sources_of(const SourceArguments& arguments);

}  // namespace geotherm::app
