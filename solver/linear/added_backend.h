// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "solver/linear/backend.h"

namespace geotherm {

/// A backend from outside the library: while this lives, it is the last of backend_names(), and
/// find_backend() finds it. It must live as long as any method that works with it. May be made and
/// gone while others look for backends. Precondition: its name is not taken.
class AddedBackend {
 public:
  explicit AddedBackend(std::unique_ptr<const Backend> backend);
  ~AddedBackend();
  AddedBackend(const AddedBackend&) = delete;
  AddedBackend& operator=(const AddedBackend&) = delete;

 private:
  std::unique_ptr<const Backend> backend_;
};

}  // namespace geotherm
