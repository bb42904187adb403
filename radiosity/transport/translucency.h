// Light that comes through translucent surfaces (scenes/material.h), from element to element:
//
//   X_i = rho_i H_i + sum_j tau_ij H_j,     tau_ij = tau_i w_ij c_j
//
// (Rushmeier, Torrance 1990), X the light scattered by row i and H the light received, W/m^2. j are
// the elements of the other side of i's patch that lie behind i, w_ij the share of i that lies over j,
// c_j the share of j on which nothing stands, both dimensionless: sum_j w_ij = 1. The surface is
// infinitely thin and the same from both sides, so a_i w_ij = a_j w_ji: what one side loses the other
// sends.
//
// With total_i = rho_i + sum_j tau_ij the equation is that of opaque surfaces,
//
//   X_i = total_i H'_i,     H'_i = (rho_i H_i + sum_j tau_ij H_j) / total_i,
//
// H' by rows T' of the transport that are mixed likewise: non-negative, with sums of at most 1. So every
// solver solves it, and every bound on its error holds.
//
// Elements of both sides are those of one patch, in the same (u, v), each divided by itself.
// Where neither is cut by what stands on it w is exact; else by 256 points of a leaf.
#pragma once

#include "radiosity/mesh/element_mesh.h"
#include "radiosity/transport/form_factor_rows.h"

#include <span>

namespace meninas {

struct TranslucentLinks {
  std::vector<std::uint32_t> row_begin; ///< rows + 1; empty where there is no translucent surface
  std::vector<std::uint32_t> columns;   ///< j
  std::vector<Rgb> transmittance;       ///< tau_ij

  bool empty() const { return columns.empty(); }
};

/// By ElementId. `exposed` likewise, the share of the area that is there and on which nothing stands;
/// empty: all that is there.
TranslucentLinks translucent_links(const ElementMesh& mesh, std::span<const float> exposed);

/// The same by columns: of j, the rows i that it sends to.
TranslucentLinks transposed(const TranslucentLinks& links);

/// sum_j tau_ij H_j
Rgb passed_from_behind(const TranslucentLinks& links, std::size_t row,
                       const std::vector<Rgb>& irradiance);

/// rho_i H_i + sum_j tau_ij H_j of all rows.
std::vector<Rgb> scattered(const std::vector<Rgb>& reflectance, const TranslucentLinks& links,
                           const std::vector<Rgb>& irradiance);

/// rho_i + sum_j tau_ij
std::vector<Rgb> total_shares(const std::vector<Rgb>& reflectance, const TranslucentLinks& links);

/// By column j, sum_i a_i tau_ij x_i / a_j: of the light that j receives what comes out behind it, as
/// much as it is worth there. `areas` are those that receive.
std::vector<Rgb> passed_on(const TranslucentLinks& links, std::span<const double> areas,
                           const std::vector<Rgb>& worth);

/// T' and the totals.
struct MixedRows {
  Transport transport;
  std::vector<Rgb> total;
};
MixedRows mixed_rows(const Transport& transport, const std::vector<Rgb>& reflectance,
                     const TranslucentLinks& links);

} // namespace meninas
