// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/backend.h"

namespace geotherm {

/// The multifrontal Cholesky factorisation of this project (Duff, Reid 1983), with factors stored
/// in narrow numbers. It needs no library beyond the standard one.
const Backend* native_backend();

/// Supernodal or simplicial Cholesky of SuiteSparse (Chen, Davis, Hager, Rajamanickam 2008).
/// Only in builds with GEOTHERM_WITH_CHOLMOD.
const Backend* cholmod_backend();

/// Simplicial LDL^T of Eigen: no dependency beyond Eigen.
const Backend* eigen_ldlt_backend();

/// Conjugate gradients with a diagonal preconditioner; never forms a matrix (Hestenes, Stiefel
/// 1952).
const Backend* cg_backend();

}  // namespace geotherm
