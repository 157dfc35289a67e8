#include "cover/save_cover.hpp"

#include <string>

#include "cover/residual.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t numbers_per_line = 12;  // as in the files of OR-Library
constexpr std::size_t terms_per_line = 10;    // LP readers limit the length of a line, the strictest to 255

/// Collects text and hands it on in large pieces.
class Text {
 public:
  explicit Text(const TextSink& out) : out_(out) {}

  Text& operator<<(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() > (std::size_t{1} << 16)) flush();
    return *this;
  }
  Text& operator<<(std::int64_t number) { return *this << std::to_string(number); }
  void flush() {
    out_(buffer_);
    buffer_.clear();
  }

 private:
  const TextSink& out_;
  std::string buffer_;
};

/// " b7 + b9 + b12", broken into lines.
template <class Name>
void sum(Text& text, std::size_t terms, Name name) {
  for (std::size_t k = 0; k < terms; ++k) {
    if (k > 0) text << (k % terms_per_line == 0 ? "\n  +" : " +");
    text << " b" << std::int64_t{name(k)};
  }
}

}  // namespace

void save_scp(const CoverState& state, const TextSink& out) {
  Text text(out);
  text << " " << static_cast<std::int64_t>(state.cols()) << " " << static_cast<std::int64_t>(state.rows())
       << "\n";
  for (std::size_t i = 0; i < state.rows(); ++i) {
    text << " 1" << ((i + 1) % numbers_per_line == 0 || i + 1 == state.rows() ? "\n" : "");
  }
  const Csr columns = transpose(rows_of(state), state.cols());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto column = columns[c];
    text << " " << static_cast<std::int64_t>(column.size()) << "\n";
    for (std::size_t k = 0; k < column.size(); ++k) {
      text << " " << std::int64_t{column[k]} + 1;
      if ((k + 1) % numbers_per_line == 0 || k + 1 == column.size()) text << "\n";
    }
  }
  text.flush();
}

void save_lp(const CoverState& state, const TextSink& out) {
  Text text(out);
  const auto id = [&state](std::int32_t row) { return state.row_ids[static_cast<std::size_t>(row)]; };
  text << "\\ Balls " << static_cast<std::int64_t>(state.rows()) << ", samples "
       << static_cast<std::int64_t>(state.cols()) << ", balls chosen before "
       << static_cast<std::int64_t>(state.chosen.size()) << "\nMinimize\n balls:";
  sum(text, state.rows(), [&](std::size_t i) { return state.row_ids[i]; });
  text << "\nSubject To\n";
  const Csr columns = transpose(rows_of(state), state.cols());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    text << " s" << std::int64_t{state.column_ids[c]} << ":";
    sum(text, columns.degree(c), [&](std::size_t k) { return id(columns[c][k]); });
    text << " >= 1\n";
  }
  text << "Binaries\n";
  for (std::size_t i = 0; i < state.rows(); ++i) text << " b" << std::int64_t{state.row_ids[i]} << "\n";
  text << "End\n";
  text.flush();
}

}  // namespace ballflow::geometry
