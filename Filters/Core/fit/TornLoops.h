// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PlaceOnMesh.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <span>

namespace neuralmesh
{
/// Fills boundary loops across which the points go on: at least half as many samples have their places on the loop as
/// the surface around it has on as large an area as it takes to fill it; of 30 edges or more, three tenths. At the end
/// of a surface, only the few have that noise has put beyond it. Outlines of sheets stay, however narrow these are.
/// `places` are those of samples of the cloud. Returns the number of loops filled.
std::size_t fillTornLoops(Mesh& mesh, std::span<const PlaceOnMesh> places);
}
