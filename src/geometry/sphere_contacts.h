#pragma once

#include <vector>

#include "spring_workbench/geometry/solid_contacts.h"

namespace spring_workbench::geometry {

/// Contacts of a sphere at `centre` with another solid, in the frame of that, with a gap below `reach` [m]. Exact at
/// any depth. With a mesh: one for each face, edge or corner that is nearest to the centre among its neighbours, so
/// that seams within a flat face do not count.
std::vector<BoxContact> sphere_contacts(double radius, const Vector3d& centre, const Solid& other, double reach);

}  // namespace spring_workbench::geometry
