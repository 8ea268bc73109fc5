// SPDX-License-Identifier: MIT
#include "app/c/handles.h"

#include <signal.h>

#include <unordered_map>
#include <utility>

namespace geotherm::c {
namespace {

/// All handles of the process: what is no handle can be told from one without looking at what it
/// points to.
struct Registry {
  std::mutex lock;
  std::uintptr_t last = 0;
  std::unordered_map<std::uintptr_t, Object> objects;
};

Registry& registry() {
  // Never destroyed: other threads may still call while the process ends.
  static Registry* const only = new Registry;
  return *only;
}

std::uintptr_t number_of(const void* handle) { return reinterpret_cast<std::uintptr_t>(handle); }

struct LastError {
  std::string message, hint;
};
thread_local LastError last_error;  // NOLINT: one a thread is what the interface promises
thread_local std::string last_text;
thread_local const Watched* innermost_call = nullptr;

/// What is done meanwhile is done from a call, on whatever thread.
class From {
 public:
  explicit From(const Watched* call) : before_(std::exchange(innermost_call, call)) {}
  ~From() { innermost_call = before_; }
  From(const From&) = delete;
  From& operator=(const From&) = delete;

 private:
  const Watched* const before_;
};

// Interrupts are counted; a call that began before one of them is cancelled by it.
std::atomic<unsigned> interrupts{0};
static_assert(std::atomic<unsigned>::is_always_lock_free);
std::mutex interrupt_lock;
int interruptible_calls = 0;
struct sigaction earlier_action;  // set before the handler can run

void count_interrupt(int signal, siginfo_t* info, void* context) {
  interrupts.fetch_add(1);
  if ((earlier_action.sa_flags & SA_SIGINFO) != 0) {
    earlier_action.sa_sigaction(signal, info, context);
  } else if (earlier_action.sa_handler != SIG_DFL && earlier_action.sa_handler != SIG_IGN) {
    earlier_action.sa_handler(signal);
  }
}

/// Whether interrupts are counted now. Who ignores them goes on doing so.
bool begin_counting() {
  const std::lock_guard lock(interrupt_lock);
  if (interruptible_calls == 0) {
    if (sigaction(SIGINT, nullptr, &earlier_action) != 0) return false;
    if ((earlier_action.sa_flags & SA_SIGINFO) == 0 && earlier_action.sa_handler == SIG_IGN) {
      return false;
    }
    struct sigaction counting = {};
    counting.sa_sigaction = count_interrupt;
    counting.sa_flags = SA_SIGINFO | SA_RESTART;
    sigemptyset(&counting.sa_mask);
    if (sigaction(SIGINT, &counting, nullptr) != 0) return false;
  }
  ++interruptible_calls;
  return true;
}

void end_counting() {
  const std::lock_guard lock(interrupt_lock);
  if (--interruptible_calls == 0) sigaction(SIGINT, &earlier_action, nullptr);
}

}  // namespace

void* add_handle(Object object) {
  Registry& all = registry();
  const std::lock_guard lock(all.lock);
  constexpr std::uintptr_t kStep = 16;  // low numbers are in no process the address of anything
  all.last += kStep;
  all.objects.emplace(all.last, std::move(object));
  return reinterpret_cast<void*>(all.last);  // NOLINT: a number that is never read through
}

std::optional<Object> find_handle(const void* handle) {
  Registry& all = registry();
  const std::lock_guard lock(all.lock);
  const auto found = all.objects.find(number_of(handle));
  if (found == all.objects.end()) return std::nullopt;
  return found->second;
}

bool remove_handle(const void* handle) {
  Registry& all = registry();
  std::optional<Object> freed;  // its destruction is no one else's business
  const std::lock_guard lock(all.lock);
  const auto found = all.objects.find(number_of(handle));
  if (found == all.objects.end()) return false;
  freed = std::move(found->second);
  all.objects.erase(found);
  return true;
}

geotherm_status keep_error(const Error& error) noexcept try {
  Error without_hint = error;
  without_hint.hint = {};
  last_error = {sentence(without_hint), hint_text(error.hint)};
  return static_cast<geotherm_status>(static_cast<int>(error.code) + 1);
} catch (...) {
  last_error.message.clear();
  last_error.hint.clear();
  return GEOTHERM_OUT_OF_MEMORY;
}

const char* keep_text(std::string text) {
  last_text = std::move(text);
  return last_text.c_str();
}

Watched::Watched(const geotherm_watch* watch) : outer_(innermost_call) {
  const bool watched =
      watch != nullptr && (watch->interruptible != 0 || watch->progress != nullptr);
  if (watched) watch_by(*watch);
  innermost_call = this;  // last: where a constructor throws, no destructor would take it back
}

void Watched::watch_by(const geotherm_watch& watch) {
  progress_ = [this, from = interrupts.load(), call = watch.progress, data = watch.data](
                  std::string_view stage, double share) {
    if (interruptible_ && interrupts.load() != from) return false;
    if (call == nullptr) return true;
    const From here(this);
    return call(data, std::string(stage).c_str(), share) == 0;
  };
  // The counting begins last: where a constructor throws, no destructor would end it.
  interruptible_ = watch.interruptible != 0 && begin_counting();
}

Watched::~Watched() {
  if (interruptible_) end_counting();
  innermost_call = outer_;
}

const Watched* Watched::innermost() { return innermost_call; }

bool Watched::is_within_one_that_holds(const Solver& solver) const {
  for (const Watched* call = outer_; call != nullptr; call = call->outer_) {
    if (call->held_ == &solver) return true;
  }
  return false;
}

}  // namespace geotherm::c

using namespace geotherm::c;  // NOLINT: the functions below are C

int geotherm_interface(void) { return GEOTHERM_INTERFACE; }

const char* geotherm_version(void) { return GEOTHERM_VERSION; }

geotherm_status geotherm_last_error(const char** message, const char** hint) {
  if (message != nullptr) *message = last_error.message.c_str();
  if (hint != nullptr) *hint = last_error.hint.c_str();
  return GEOTHERM_OK;
}

geotherm_status geotherm_free(void* handle) {
  return guarded([&]() -> geotherm::Result<void> {
    if (handle == nullptr || remove_handle(handle)) return {};
    return bad_argument("handle is no handle, or was freed before");
  });
}
