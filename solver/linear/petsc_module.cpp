// SPDX-License-Identifier: MIT
// The library geotherm-mpi.so: the one place that knows MPI and PETSc.
#include <petscksp.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "solver/linear/mpi_module.h"

namespace {

/// The communicator of all ranks, which barrier() alone uses.
MPI_Comm meeting = MPI_COMM_NULL;

/// The text as C has it; it stays in memory until the next call on this thread.
const char* c_text(std::string text) {
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
  MPI_Comm_dup(MPI_COMM_WORLD, &meeting);
  // Each process solves for itself, and signals are the program's: PETSc would leave none of its
  // handlers, which remove files that were begun.
  PETSC_COMM_WORLD = MPI_COMM_SELF;
  PetscErrorCode code = PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
  if (code == 0) code = PetscInitializeNoArguments();
  if (code == 0) code = PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  if (code != 0) return c_text(words_of(code));
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

constexpr std::int64_t kPiece = std::int64_t{1} << 30;  // MPI counts in int

void all_gather(const char* bytes, std::int64_t size, void* context,
                void (*take)(void*, const char*, std::int64_t)) {
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

void all_to_all(const char* bytes, const std::int64_t* sizes, void* context,
                char* (*room)(void*, const std::int64_t*)) {
  constexpr int kTag = 1;
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  std::vector<std::int64_t> theirs(static_cast<std::size_t>(count));
  MPI_Alltoall(sizes, 1, MPI_INT64_T, theirs.data(), 1, MPI_INT64_T, MPI_COMM_WORLD);
  char* to = room(context, theirs.data());
  std::vector<MPI_Request> open;
  const auto in_pieces = [&](std::int64_t size, const auto& call) {
    for (std::int64_t at = 0; at < size; at += kPiece) {
      call(at, static_cast<int>(std::min(kPiece, size - at)), &open.emplace_back());
    }
  };
  for (int rank = 0; rank < count; ++rank) {
    const std::int64_t size = theirs[static_cast<std::size_t>(rank)];
    in_pieces(size, [&](std::int64_t at, int length, MPI_Request* request) {
      MPI_Irecv(to + at, length, MPI_BYTE, rank, kTag, MPI_COMM_WORLD, request);
    });
    to += size;
  }
  for (int rank = 0; rank < count; ++rank) {
    in_pieces(sizes[rank], [&](std::int64_t at, int length, MPI_Request* request) {
      MPI_Isend(bytes + at, length, MPI_BYTE, rank, kTag, MPI_COMM_WORLD, request);
    });
    bytes += sizes[rank];
  }
  MPI_Waitall(static_cast<int>(open.size()), open.data(), MPI_STATUSES_IGNORE);
}

void all_reduce(double* values, std::int64_t count, geotherm::MpiModule::Reduction how) {
  using enum geotherm::MpiModule::Reduction;
  const MPI_Op operation = how == kSum ? MPI_SUM : how == kMin ? MPI_MIN : MPI_MAX;
  for (std::int64_t at = 0; at < count; at += kPiece) {
    MPI_Allreduce(MPI_IN_PLACE, values + at, static_cast<int>(std::min(kPiece, count - at)),
                  MPI_DOUBLE, operation, MPI_COMM_WORLD);
  }
}

bool barrier(double seconds) {
  constexpr useconds_t kBetweenLooks = 1000;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(meeting, &request);
  int there = 0;
  if (seconds < 0) there = MPI_Wait(&request, MPI_STATUS_IGNORE) == MPI_SUCCESS;
  for (const double end = MPI_Wtime() + seconds; !there && MPI_Wtime() < end;) {
    MPI_Test(&request, &there, MPI_STATUS_IGNORE);
    if (!there) ::usleep(kBetweenLooks);
  }
  return there != 0;
}

void abort_all(int exit_code) { MPI_Abort(MPI_COMM_WORLD, exit_code); }

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

/// Conjugate gradients with BoomerAMG for the matrix that `make` makes; what is not set up is so by
/// the first solve, when arrays that were copied are gone.
template <class Make>
void* solver_for(MPI_Comm ranks, const Make& make, bool set_up, const char** problem) {
  auto solver = std::make_unique<Solver>();
  Solver& s = *solver;
  PC preconditioner = nullptr;
  const PetscErrorCode code = in_turn(
      [&] { return make(&s.matrix); }, [&] { return MatSetOption(s.matrix, MAT_SPD, PETSC_TRUE); },
      [&] { return MatCreateVecs(s.matrix, &s.answer, &s.right); },
      [&] { return KSPCreate(ranks, &s.method); },
      [&] { return KSPSetOperators(s.method, s.matrix, s.matrix); },
      [&] { return KSPSetType(s.method, KSPCG); },
      [&] { return KSPSetNormType(s.method, KSP_NORM_UNPRECONDITIONED); },
      [&] { return KSPGetPC(s.method, &preconditioner); },
      [&] { return PCSetType(preconditioner, PCHYPRE); },
      [&] { return PCHYPRESetType(preconditioner, "boomeramg"); },
      [&] { return KSPSetFromOptions(s.method); },
      [&] { return set_up ? KSPSetUp(s.method) : PetscErrorCode{}; });
  if (code == 0) return solver.release();
  *problem = c_text(words_of(code));
  return nullptr;
}

void* make_solver(int n, int* start, int* column, double* value, const char** problem) {
  return solver_for(
      PETSC_COMM_SELF,
      [&](Mat* matrix) {
        return MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, start, column, value, matrix);
      },
      true, problem);
}

void* make_shared_solver(int rows, const int* start, const int* column, const double* value,
                         const char** problem) {
  return solver_for(
      MPI_COMM_WORLD,
      [&](Mat* matrix) {
        return MatCreateMPIAIJWithArrays(MPI_COMM_WORLD, rows, rows, PETSC_DETERMINE,
                                         PETSC_DETERMINE, start, column, value, matrix);
      },
      false, problem);
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
  if (code != 0) return c_text(words_of(code));
  if (reason > 0) return "";
  return c_text("conjugate gradients with BoomerAMG ended after " + std::to_string(taken) +
                " iterations (reason " + std::to_string(reason) + " of PETSc)");
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const geotherm::MpiModule*
geotherm_mpi_module_3() {
  static constexpr geotherm::MpiModule kModule = {
      start_all,          all_gather,  all_to_all, all_reduce, finish,   make_solver,
      make_shared_solver, free_solver, solve,      barrier,    abort_all};
  return &kModule;
}
