// Greedy set covering of a plain matrix (Kornberger 2010, Listing 3.1).
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {

/// The row that covers most of what is left, again and again, in the order of the picks; ties go to the
/// lowest index. Every column is in a row.
std::vector<std::int32_t> greedy_rows(const Csr& rows, std::size_t columns, Monitor& monitor = no_monitor());

/// `picks` without those whose columns the remaining ones cover, shortest first; in the same order.
std::vector<std::int32_t> without_redundant(const Csr& rows, std::size_t columns,
                                            const std::vector<std::int32_t>& picks,
                                            Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
