// SPDX-License-Identifier: MIT
// The library geotherm-mpi.so: the one place that knows MPI and PETSc.
#include <petscksp.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "solver/linear/mpi_module.h"

namespace {

/// Kept until the next problem.
const char* told(std::string text) {
  static thread_local std::string kept;
  kept = std::move(text);
  return kept.c_str();
}

std::string words_of(PetscErrorCode code) {
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  return "PETSc: " + std::string(text != nullptr ? text : "error") + " (" + std::to_string(code) +
         ")";
}

/// The first of these calls that fails, or 0.
template <class... Calls>
PetscErrorCode in_turn(Calls&&... calls) {
  PetscErrorCode code = {};
  (void)((code = calls(), code == 0) && ...);
  return code;
}

const char* start_all(int* rank, int* count) {
  // A process that nobody launched needs no daemon for others.
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && std::getenv("PMIX_RANK") == nullptr) {
    ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  }
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
  int given = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given) != MPI_SUCCESS) {
    return "MPI_Init failed";
  }
  MPI_Comm_rank(MPI_COMM_WORLD, rank);
  MPI_Comm_size(MPI_COMM_WORLD, count);
  // Each process solves for itself, and signals are the program's.
  PETSC_COMM_WORLD = MPI_COMM_SELF;
  PetscErrorCode code = PetscInitializeNoArguments();
  if (code == 0) code = PetscPopSignalHandler();
  if (code == 0) code = PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  if (code != 0) return told(words_of(code));
  // BoomerAMG's settings exist as options alone.
  const char* const settings[][2] = {{"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
                                     {"-pc_hypre_boomeramg_interp_type", "ext+i"},
                                     {"-pc_hypre_boomeramg_P_max", "4"},
                                     {"-pc_hypre_boomeramg_strong_threshold", "0.25"}};
  for (const auto& [name, value] : settings) {
    PetscBool is_set = PETSC_FALSE;  // by the user, in PETSC_OPTIONS
    PetscOptionsHasName(nullptr, nullptr, name, &is_set);
    if (!is_set) PetscOptionsSetValue(nullptr, name, value);
  }
  return "";
}

void exchange(const char* bytes, std::int64_t size, void* context,
              void (*take)(void*, const char*, std::int64_t)) {
  constexpr std::int64_t kPiece = std::int64_t{1} << 30;  // MPI counts in int
  int rank = 0, count = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  std::vector<char> theirs;
  for (int root = 0; root < count; ++root) {
    std::int64_t length = size;
    MPI_Bcast(&length, 1, MPI_INT64_T, root, MPI_COMM_WORLD);
    theirs.resize(static_cast<std::size_t>(length));
    if (root == rank) std::copy_n(bytes, length, theirs.data());
    for (std::int64_t at = 0; at < length; at += kPiece) {
      MPI_Bcast(theirs.data() + at, static_cast<int>(std::min(kPiece, length - at)), MPI_BYTE, root,
                MPI_COMM_WORLD);
    }
    take(context, theirs.data(), length);
  }
}

void finish() {
  PetscFinalize();
  MPI_Finalize();
}

struct Solver {
  Mat matrix = nullptr;
  KSP method = nullptr;
  Vec right = nullptr, answer = nullptr;

  ~Solver() {
    VecDestroy(&right);
    VecDestroy(&answer);
    KSPDestroy(&method);
    MatDestroy(&matrix);
  }
};

static_assert(sizeof(PetscInt) == sizeof(int) && sizeof(PetscScalar) == sizeof(double));

void* make_solver(int n, int* start, int* column, double* value, const char** problem) {
  auto solver = std::make_unique<Solver>();
  Solver& s = *solver;
  PC preconditioner = nullptr;
  const PetscErrorCode code = in_turn(
      [&] {
        return MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, start, column, value, &s.matrix);
      },
      [&] { return MatSetOption(s.matrix, MAT_SPD, PETSC_TRUE); },
      [&] { return MatCreateVecs(s.matrix, &s.answer, &s.right); },
      [&] { return KSPCreate(PETSC_COMM_SELF, &s.method); },
      [&] { return KSPSetOperators(s.method, s.matrix, s.matrix); },
      [&] { return KSPSetType(s.method, KSPCG); },
      [&] { return KSPSetNormType(s.method, KSP_NORM_UNPRECONDITIONED); },
      [&] { return KSPGetPC(s.method, &preconditioner); },
      [&] { return PCSetType(preconditioner, PCHYPRE); },
      [&] { return PCHYPRESetType(preconditioner, "boomeramg"); },
      [&] { return KSPSetFromOptions(s.method); }, [&] { return KSPSetUp(s.method); });
  if (code == 0) return solver.release();
  *problem = told(words_of(code));
  return nullptr;
}

void free_solver(void* solver) { delete static_cast<Solver*>(solver); }

const char* solve(void* solver, const double* b, double* x, double tolerance, int* iterations) {
  constexpr PetscInt kMaxIterations = 500;
  constexpr PetscReal kLeast = 1e-300, kDiverged = 1e10;
  Solver& s = *static_cast<Solver*>(solver);
  PetscScalar* entries = nullptr;
  const PetscScalar* found = nullptr;
  PetscInt n = 0, taken = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  const PetscErrorCode code = in_turn(
      [&] { return KSPSetTolerances(s.method, tolerance, kLeast, kDiverged, kMaxIterations); },
      [&] { return VecGetLocalSize(s.right, &n); }, [&] { return VecGetArray(s.right, &entries); },
      [&] {
        std::copy_n(b, n, entries);
        return VecRestoreArray(s.right, &entries);
      },
      [&] { return KSPSolve(s.method, s.right, s.answer); },
      [&] { return KSPGetIterationNumber(s.method, &taken); },
      [&] { return KSPGetConvergedReason(s.method, &reason); },
      [&] { return VecGetArrayRead(s.answer, &found); },
      [&] {
        std::copy_n(found, n, x);
        return VecRestoreArrayRead(s.answer, &found);
      });
  *iterations = static_cast<int>(taken);
  if (code != 0) return told(words_of(code));
  if (reason > 0) return "";
  return told("conjugate gradients with BoomerAMG ended after " + std::to_string(taken) +
              " iterations (reason " + std::to_string(reason) + " of PETSc)");
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const geotherm::MpiModule*
geotherm_mpi_module_1() {
  static constexpr geotherm::MpiModule kModule = {start_all,   exchange,    finish,
                                                  make_solver, free_solver, solve};
  return &kModule;
}
