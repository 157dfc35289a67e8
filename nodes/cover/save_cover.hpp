// Covering matrices as files that other solvers read.
#pragma once

#include <functional>
#include <string_view>

#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// Receives a file piece by piece.
using TextSink = std::function<void(std::string_view)>;

/// The residual matrix as an OR-Library scp file of cost 1: sets are rows, elements are columns, both
/// numbered from 1 by their place in the matrix (not by row_ids and column_ids). load_cover reads it back.
/// What was chosen or is covered by nothing is not in it.
void save_scp(const CoverState& state, const TextSink& out);

/// The residual matrix as an integer program in LP format (CPLEX), which CBC, HiGHS, GLPK and SCIP read:
/// minimise the sum of binary variables b<ball> such that, for every constraint s<sample>, the balls that
/// cover the sample sum to at least 1. Balls and samples have their original numbers, from 0.
void save_lp(const CoverState& state, const TextSink& out);

}  // namespace ballflow::geometry
