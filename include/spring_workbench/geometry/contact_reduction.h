#pragma once

#include <vector>

#include "spring_workbench/geometry/box_contacts.h"

namespace spring_workbench::geometry {

/// Returns up to four of the contacts with about one normal: the deepest, the one furthest from it, and on either side
/// of the line between them the one furthest from that, unless they are nearer than `same_point` [m].
std::vector<BoxContact> spanning(const std::vector<BoxContact>& all, double same_point);

/// Returns contacts by their normals, those with the smallest gap first; some of each, as spanning() does.
/// `one_normal`: cosine of the angle between normals that count as one.
std::vector<std::vector<BoxContact>> by_normal(std::vector<BoxContact> contacts, double one_normal, double same_point);

}  // namespace spring_workbench::geometry
