/* SPDX-License-Identifier: MIT */
#ifndef GEOTHERM_C_H
#define GEOTHERM_C_H

/* Geodesic distance from C, and from any language that can call C. (The library's own interface is
 * C++: <geotherm/geotherm.h>.)
 *
 *   geotherm_model *model;  geotherm_solver *solver;  double d[V];
 *   geotherm_model_read("bunny.ply", NULL, NULL, &model);
 *   geotherm_solver_new(model, NULL, NULL, &solver);
 *   geotherm_distance(solver, &sources, &out, NULL);
 *   geotherm_free(solver);  geotherm_free(model);
 *
 * Handles: a geotherm_model, _options, _solver or _answer is a number in the shape of a pointer,
 * which nothing reads through. What is no handle, or was freed, is an error of the call, never a
 * crash. Each lives until geotherm_free(), independent of what it was made from.
 * Threads: all calls may be made from several threads at once, also with the same handles. With one
 * solver geotherm_solve(), _path(), _paths(), _solver_move() and, by heat, _relax() wait for each
 * other, distances do not; where one of them would wait for the call whose progress makes it, it is
 * BAD_INPUT.
 * Memory: arrays that a call reads are copied before it returns; arrays that it fills are the
 * caller's. Texts belong to the library and last until the next call of the same thread.
 * Units: lengths are in the model's own. Vertices and faces are numbered from 0, as in the file or
 * the arrays given. A distance is infinite where no source can be reached from.
 * Nothing is printed, no exception leaves, and no call ends the program. */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GEOTHERM_API __attribute__((visibility("default")))

/* ---- Versions ---------------------------------------------------------------------------------*/

/* The number of this interface, and of the library's file (libgeotherm.so.0): it grows when a
 * function or a structure that was there changes. */
#define GEOTHERM_INTERFACE 0

/* That of the library at run time; a program checks that it is GEOTHERM_INTERFACE. */
GEOTHERM_API int geotherm_interface(void);

/* The version of the program that it belongs to, such as "0.1.0". Never NULL. */
GEOTHERM_API const char* geotherm_version(void);

/* ---- Errors -----------------------------------------------------------------------------------*/

/* What became of a call. */
typedef enum geotherm_status {
  GEOTHERM_OK = 0,
  GEOTHERM_BAD_INPUT = 1,         /* the arguments or the model itself; another input would work */
  GEOTHERM_BAD_FILE = 2,          /* a file that cannot be opened, read, parsed or written */
  GEOTHERM_NOT_AVAILABLE = 3,     /* a name that this build does not know */
  GEOTHERM_NUMERICAL_FAILURE = 4, /* a matrix that cannot be factored, a value that is not finite */
  GEOTHERM_BUDGET_ENDED = 5,      /* an iteration budget ended before the tolerance was reached */
  GEOTHERM_OUT_OF_MEMORY = 6,
  GEOTHERM_CANCELLED = 7, /* by geotherm_watch */
  GEOTHERM_NO_DEVICE = 8
} geotherm_status;

/* Of the last call of this thread that failed: one sentence with the argument and the numbers, and
 * what to do about it ("" where nothing is known to help). Either pointer may be NULL. */
GEOTHERM_API geotherm_status geotherm_last_error(const char** message, const char** hint);

/* ---- Arrays -----------------------------------------------------------------------------------*/

/* Of the numbers of an array. */
typedef enum geotherm_type {
  GEOTHERM_FLOAT64 = 0,
  GEOTHERM_FLOAT32 = 1,
  GEOTHERM_INT64 = 2,
  GEOTHERM_INT32 = 3
} geotherm_type;

/* rows x columns numbers; a list has one column. Strides are bytes from one row and from one column
 * to the next, below 0 where it runs backwards; both 0: row after row without gaps. `data` may be
 * NULL where there are no rows. Numbers of a model are taken from any type; a whole number that is
 * given as floating-point must be one. */
typedef struct geotherm_array {
  void* data;
  geotherm_type type;
  int64_t rows, columns;
  int64_t row_stride, column_stride;
} geotherm_array;

/* ---- Long work --------------------------------------------------------------------------------*/

/* NULL in its place: nobody watches. `progress` is told the stage and the share done (0 to 1, below
 * 0 when unknown); other than 0 cancels the call (GEOTHERM_CANCELLED), which leaves nothing behind.
 * It is called from any thread of the work, one at a time, and must return. */
typedef struct geotherm_watch {
  int (*progress)(void* data, const char* stage, double share); /* or NULL */
  void* data;
  int interruptible; /* not 0: Ctrl-C (SIGINT) cancels, too; the program's handler runs as well */
} geotherm_watch;

/* ---- Options ----------------------------------------------------------------------------------*/

/* A handle: how models are read, solved and checked. */
typedef struct geotherm_options geotherm_options;

/* Every option of the command line that is about models, methods and checks, by its name there
 * without dashes ("method", "time-factor", "threads", "weld", "check"), as text ("2"). Errors of
 * set: NOT_AVAILABLE (no such name; a value that should be one of several names, such as a backend,
 * and is none: with those there are), BAD_INPUT (another value). */
GEOTHERM_API geotherm_status geotherm_options_new(geotherm_options** options);
GEOTHERM_API geotherm_status geotherm_options_set(geotherm_options* options, const char* name,
                                                  const char* value);
GEOTHERM_API geotherm_status geotherm_options_get(const geotherm_options* options, const char* name,
                                                  const char** value);

/* What this build has, as JSON: version, interface, methods, backends, formats of files, models
 * that come with it, fields of answers, and settings (name, group, help, default, values). */
GEOTHERM_API geotherm_status geotherm_features(const char** json);

/* ---- Models -----------------------------------------------------------------------------------*/

/* A handle: where distances are wanted. */
typedef struct geotherm_model geotherm_model;

/* Reads a file, or a bundled model by its name. Of `options` (or NULL) those about models count:
 * domain, mask, weld, format, grid. Errors: BAD_FILE, BAD_INPUT, NOT_AVAILABLE. */
GEOTHERM_API geotherm_status geotherm_model_read(const char* path, const geotherm_options* options,
                                                 const geotherm_watch* watch,
                                                 geotherm_model** model);

/* What a model is made of. */
typedef enum geotherm_kind {
  GEOTHERM_TRIANGLES = 0, /* positions V x 3, cells F x 3; values: none, or a mask */
  GEOTHERM_POLYGONS = 1,  /* positions, cells: corners of all faces, one after the other; starts */
  GEOTHERM_TETS = 2,      /* positions, cells T x 4 */
  GEOTHERM_POINTS = 3,    /* positions; values: normals V x 3, or none */
  GEOTHERM_GRID = 4,      /* size, spacing, origin; values: a speed for each sample, x fastest, 0 is
                             wall; or none: 1 everywhere. The answer is travel time */
  GEOTHERM_LENGTHS = 5    /* triangles that lie nowhere: cells F x 3, of vertices below 3 F, values
                             F x 3: the length of the side opposite each corner, whose squares are
                             doubles; the heat method alone, not checked */
} geotherm_kind;

/* A model as arrays. A mask of triangles has V numbers, or F: what has another one than 0 is left
 * out, and keeps its own number. */
typedef struct geotherm_shape {
  geotherm_kind kind;
  geotherm_array positions, cells, values;
  geotherm_array starts; /* of polygons: faces + 1; face f has the corners starts[f] to
                            starts[f + 1] of `cells` */
  int64_t size[3];       /* of grids: samples along x, y, z; 1 along z in two dimensions */
  double spacing[3], origin[3];
} geotherm_shape;

/* Of arrays. `options`: weld alone counts, of triangles. Errors: BAD_INPUT, with the array's name
 * and the number that is wrong. Cost: a pass over the arrays; points are joined to a surface. */
GEOTHERM_API geotherm_status geotherm_model_build(const geotherm_shape* shape,
                                                  const geotherm_options* options,
                                                  const geotherm_watch* watch,
                                                  geotherm_model** model);

/* ---- Solvers ----------------------------------------------------------------------------------*/

/* A handle: a model made ready for sources. */
typedef struct geotherm_solver geotherm_solver;

/* A model made ready for sources by the method of `options` (or NULL: the heat method). Cost: with
 * `heat` two factorisations. Errors: BAD_FILE (the model has no area and the like),
 * NUMERICAL_FAILURE, OUT_OF_MEMORY, CANCELLED. */
GEOTHERM_API geotherm_status geotherm_solver_new(const geotherm_model* model,
                                                 const geotherm_options* options,
                                                 const geotherm_watch* watch,
                                                 geotherm_solver** solver);

/* The same faces and options with the vertices elsewhere (V x 3): by heat without refinement half
 * of the cost of a new one. The earlier solver stays as it is. `model`, where it is not NULL, is
 * what it is on. */
GEOTHERM_API geotherm_status geotherm_solver_move(const geotherm_solver* solver,
                                                  const geotherm_array* positions,
                                                  const geotherm_watch* watch,
                                                  geotherm_solver** moved, geotherm_model** model);

/* ---- Sources ----------------------------------------------------------------------------------*/

/* How a source is given. */
typedef enum geotherm_place {
  GEOTHERM_VERTEX = 0, /* id */
  GEOTHERM_FACE = 1,   /* id; at: weights of its corners, not negative, with the sum 1 */
  GEOTHERM_XYZ = 2     /* at: a place; the nearest point of the model */
} geotherm_place;

/* A point from which distance is measured. */
typedef struct geotherm_source {
  int64_t kind; /* geotherm_place */
  int64_t id;
  double at[3];
  double offset; /* the distance there, >= 0; the methods but heat know it */
} geotherm_source;

/* Points, and sources as on the command line, one a line ("17", "3,99", "random:5:1", "boundary",
 * "curve:1,2,3", "face:7:0.2:0.3:0.5"); either may be left out. Where many sets are asked for,
 * `starts` has sets + 1 numbers, and set k the points starts[k] to starts[k + 1]; NULL: each point
 * is a set, and so is each point of the text. */
typedef struct geotherm_sources {
  const geotherm_source* points;
  int64_t count;
  const int64_t* starts;
  int64_t sets;
  const char* text;
} geotherm_sources;

/* ---- Distances --------------------------------------------------------------------------------*/

/* From one set, all its points together, into `out`: V numbers, FLOAT64 or FLOAT32. No check, no
 * figures: the fastest way. The numbers are those of the command line, to the last bit. */
GEOTHERM_API geotherm_status geotherm_distance(const geotherm_solver* solver,
                                               const geotherm_sources* sources,
                                               const geotherm_array* out,
                                               const geotherm_watch* watch);

/* Where the rows of many sets go: K x V numbers, or K x targets. */
typedef struct geotherm_rows {
  geotherm_array array;   /* the caller's memory, of which a path leaves all but the type alone;
                             without data and path the call only says its rows and columns */
  const char* path;       /* NULL, or a file .npy of array.type, there whole or not at all; .npz:
                             what is reached alone, as scipy.sparse.load_npz() reads it */
  const int64_t* targets; /* NULL, or the vertices whose distances are kept */
  int64_t target_count;
  double max_distance; /* > 0; farther is infinite. INFINITY for all. The methods but heat spend
                          no time beyond it, nor beyond the last of the targets */
} geotherm_rows;

/* From each set by itself, in blocks of sixteen, in memory for two chunks of these however many
 * there are. The rows have the bits of `solve --each`. */
GEOTHERM_API geotherm_status geotherm_distances(const geotherm_solver* solver,
                                                const geotherm_sources* sources,
                                                geotherm_rows* rows, const geotherm_watch* watch);

/* ---- Answers ----------------------------------------------------------------------------------*/

/* A handle: what a call has found. */
typedef struct geotherm_answer geotherm_answer;

/* From one set with all that there is to say: what `solve` of the command line reports. `wanted`:
 * NULL, or words with blanks between: "labels" (nearest_source), "fields" (heat, log_heat and the
 * fields that need them), "check=..." in place of the option `check` of the solver,
 * "max-distance=..." (farther is infinite; where nothing is checked no time is spent there). */
GEOTHERM_API geotherm_status geotherm_solve(const geotherm_solver* solver,
                                            const geotherm_sources* sources, const char* wanted,
                                            const geotherm_watch* watch, geotherm_answer** answer);

/* The shortest path through two points or more, in order. `field`: "geodesic" (or NULL),
 * "distance", "heat". `closed`: 1 leads back to the first point; 2: it is open, and the points
 * between its ends only say where it runs at first, so that it is pulled straight past them. On
 * triangles and points alone. */
GEOTHERM_API geotherm_status geotherm_path(const geotherm_solver* solver,
                                           const geotherm_sources* through, const char* field,
                                           int closed, const geotherm_watch* watch,
                                           geotherm_answer** lines);

/* The shortest paths from one point to each of others, in their order; the distances from it are
 * computed once. */
GEOTHERM_API geotherm_status geotherm_paths(const geotherm_solver* solver,
                                            const geotherm_sources* from,
                                            const geotherm_sources* to, const geotherm_watch* watch,
                                            geotherm_answer** lines);

/* The level sets of the function that is linear on each face. values: V; levels: ascending. Errors:
 * BAD_INPUT, too, on a surface of edge lengths, whose vertices have no places. */
GEOTHERM_API geotherm_status geotherm_isolines(const geotherm_model* model,
                                               const geotherm_array* values,
                                               const geotherm_array* levels,
                                               const geotherm_watch* watch,
                                               geotherm_answer** lines);

/* Farthest-point samples. `first`: a vertex, or -1. Cost: a query for each. */
GEOTHERM_API geotherm_status geotherm_samples(const geotherm_solver* solver, int64_t count,
                                              int64_t first, const geotherm_watch* watch,
                                              geotherm_answer** samples);

/* Lloyd's iteration: each point moves to the mean of the vertices that are nearest to it, `steps`
 * times or until the energy, the sum of area times distance^2, does not fall. By the solver's
 * distances, in place of heat by wavefront's. The arrays points K x 3, faces K, weights K x 3 (the
 * points in these), distances V, nearest_source V, energies (before the first step and after each),
 * moves (the farthest of each step), settled (1: the last step gained nothing). */
GEOTHERM_API geotherm_status geotherm_relax(const geotherm_solver* solver,
                                            const geotherm_sources* points, int64_t steps,
                                            const geotherm_watch* watch, geotherm_answer** relaxed);

/* ---- Directions: on triangles and points alone ------------------------------------------------*/

/* What they need of a model is made by the first call and kept with it: Directions for maps and
 * lines; a factorisation for values, and a second one for vectors, by the options of the last call,
 * which share what the last solver of the model has set up; for signed distances, the waves that
 * lead curves.
 *
 * In a tangent frame, an angle in radians from e1 towards e2; frames are arrays of nine numbers:
 * e1, e2 and the normal. At a vertex e1 lies below its first edge, and angles are scaled to 2 pi
 * round it, but on the boundary; in a face e1 leads from its first corner to the second. */

/* Polar coordinates of all vertices about one point: the arrays distances V, directions V (no
 * number where no path leads), frame 1 x 9. `method`: "exact" (or NULL; exact on the faces),
 * "wavefront", "wavefront-fine" (near exact, and fast). What is farther than `max_distance` (> 0,
 * INFINITY for all) is infinite, and no time is spent there. */
GEOTHERM_API geotherm_status geotherm_log_map(const geotherm_model* model,
                                              const geotherm_sources* point, const char* method,
                                              double max_distance, const geotherm_watch* watch,
                                              geotherm_answer** map);

/* The mean or median of points, with weights (K numbers from 0 on) or without (NULL): where the sum
 * of weight times distance^2, or of weight times distance, is least. `kind`: "mean" (or NULL),
 * "median"; `method`: of log maps, as above. All minima that were found and are about as low, the
 * least first: the arrays points N x 3, faces N, weights N x 3 (the points in these), energies N
 * (that sum over the sum of the weights), residuals N (length of the step that was left to do),
 * converged N (0 or 1), distances N x K; the text "warnings" says where there are several. */
GEOTHERM_API geotherm_status geotherm_centres(const geotherm_model* model,
                                              const geotherm_sources* points,
                                              const geotherm_array* weights, const char* kind,
                                              const char* method, const geotherm_watch* watch,
                                              geotherm_answer** centres);

/* The straightest line from one point. The text "end" of the line is "length", or why it is
 * shorter: "border", "split" (three faces at an edge, or several fans at a vertex). */
GEOTHERM_API geotherm_status geotherm_trace(const geotherm_model* model,
                                            const geotherm_sources* point, double direction,
                                            double length, const geotherm_watch* watch,
                                            geotherm_answer** line);

/* Vectors given at vertices (K numbers, K x 2 along e1 and e2 there) carried to all: the arrays
 * vectors V x 3 (in space), components V x 2, frames V x 9. Of `options` (or NULL) backend,
 * time-factor and threads count. */
GEOTHERM_API geotherm_status geotherm_transport(
    const geotherm_model* model, const geotherm_options* options, const geotherm_array* vertices,
    const geotherm_array* vectors, const geotherm_watch* watch, geotherm_answer** answer);

/* The same of values (K numbers): the array values V. */
GEOTHERM_API geotherm_status geotherm_extend(const geotherm_model* model,
                                             const geotherm_options* options,
                                             const geotherm_array* vertices,
                                             const geotherm_array* values,
                                             const geotherm_watch* watch, geotherm_answer** answer);

/* Distance to directed curves, negative to their left: the array distances V, the text "rule". Each
 * set of `curves` is one, through its points by geodesics; `closed`: not 0 leads each back to its
 * first. `rule`: "auto" (or NULL), "sides" (exact, for curves that separate the surface), "heat"
 * (the signed heat method, which closes gaps). Of `options` (or NULL) backend, time-factor and
 * threads count. */
GEOTHERM_API geotherm_status geotherm_signed_distance(const geotherm_model* model,
                                                      const geotherm_options* options,
                                                      const geotherm_sources* curves, int closed,
                                                      const char* rule, const geotherm_watch* watch,
                                                      geotherm_answer** answer);

/* ---- What a handle holds ----------------------------------------------------------------------*/

/* An array inside of a model or an answer, to be read and not written, valid as long as the handle.
 * Models: positions V x 3, faces F x 3 (of what is drawn of other spaces).
 * Answers of geotherm_solve(): distances V; nearest_source V; heat, log_heat V; error V or F, and
 * the other fields by their names on the command line ("eikonal-error"). Lines: points N x 3, faces
 * N, weights N x 3 (the points in these), starts (lines + 1: the points of each), lengths, closed
 * (0 or 1), values (of isolines). Samples: vertices K, distances V, nearest_source V (number of the
 * sample), radius K. Errors: NOT_AVAILABLE, with the names there are. */
GEOTHERM_API geotherm_status geotherm_array_of(const void* handle, const char* name,
                                               geotherm_array* array);

/* Texts. Models: "json" (all of `info`), "table", "name", "domain", "summary". Solvers: "json"
 * (times in ms, memory in MB, warnings). Answers of geotherm_solve(): "json", "table"; all other
 * answers: "warnings", a JSON list of sentences. Lines of geotherm_trace(), too: "end". Signed
 * distances, too: "rule". */
GEOTHERM_API geotherm_status geotherm_text_of(const void* handle, const char* name,
                                              const char** text);

/* Writes a model (.ply, .obj, .off, .stl, of tets .mesh and .vtu, too), an answer of
 * geotherm_solve() (.csv, .npy, .ply, .vtp, of tets .vtu, of grids .vti) or lines (.obj, .csv,
 * .vtp) by the ending of the path: whole or not at all. */
GEOTHERM_API geotherm_status geotherm_write(const void* handle, const char* path);

/* Ends a handle of any kind; NULL is left alone. Calls that work with it go on. Errors: BAD_INPUT
 * (no handle, or freed before). */
GEOTHERM_API geotherm_status geotherm_free(void* handle);

#ifdef __cplusplus
}
#endif

#endif
