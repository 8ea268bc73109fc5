// SPDX-License-Identifier: MIT
#pragma once

// Geodesic distance on triangle meshes: all of the library. With read_mesh() (io.h) or
// TriangleMesh::build() (mesh.h) there is a mesh, with build_method() (build_method.h) a method on
// it, with DistanceMethod::solve() (distance_method.h) the distances from a SourceSet (sources.h).
// Expected failures are values (error.h). Lengths are in the model's own units.

#include "geotherm/accuracy.h"
#include "geotherm/backend.h"
#include "geotherm/build_method.h"
#include "geotherm/directions.h"
#include "geotherm/distance_method.h"
#include "geotherm/domains.h"
#include "geotherm/error.h"
#include "geotherm/heat_method.h"
#include "geotherm/io.h"
#include "geotherm/many.h"
#include "geotherm/mesh.h"
#include "geotherm/mesh_report.h"
#include "geotherm/names.h"
#include "geotherm/options.h"
#include "geotherm/path.h"
#include "geotherm/polyhedral_methods.h"
#include "geotherm/progress.h"
#include "geotherm/sources.h"
#include "geotherm/types.h"
