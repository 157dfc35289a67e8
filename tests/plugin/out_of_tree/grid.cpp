// An artifact type of somebody else, a node that makes it and one that takes it.
#include <ballflow/sdk.hpp>

#include "base/array.hpp"

using namespace ballflow;

namespace acme {

struct Grid {
  std::array<std::int64_t, 2> size{};
  geometry::Array<double> values;  // row by row
};

}  // namespace acme

template <>
struct ballflow::TypeOf<acme::Grid> {
  static void declare(TypeDecl<acme::Grid>& d) {
    d.id("acme.Grid", 1).doc("A rectangle of numbers.");
    d.scalar("size", &acme::Grid::size).doc("columns and rows");
    d.array("values", &acme::Grid::values).length("n").doc("columns times rows numbers, row by row");
    d.summary("cells", "how many numbers");
    d.summarize([](const acme::Grid& grid) { return Summary{{"cells", grid.values.size()}}; });
    d.check([](const acme::Grid& grid) {
      const std::int64_t cells = grid.size[0] * grid.size[1];
      if (static_cast<std::int64_t>(grid.values.size()) == cells) return std::string();
      return std::to_string(grid.values.size()) + " numbers for " + std::to_string(cells) + " cells";
    });
  }
};

namespace acme {

struct MakeGrid {
  Out<Grid> grid;
  std::int64_t columns = 4, rows = 3, missing = 0;

  static void declare(NodeDecl<MakeGrid>& d) {
    d.id("acme.MakeGrid", 1).summary("Numbers the cells of a grid.");
    d.output("grid", &MakeGrid::grid).doc("0, 1, 2, ... row by row");
    d.param("columns", &MakeGrid::columns).unit("1").at_least(1).at_most(1000).doc("cells of a row");
    d.param("rows", &MakeGrid::rows).unit("1").at_least(1).at_most(1000).doc("rows");
    d.param("missing", &MakeGrid::missing)
        .unit("1")
        .at_least(0)
        .doc("leaves so many out: more than 0 is wrong");
  }
  void run(RunContext&) {
    std::vector<double> values(static_cast<std::size_t>(columns * rows - missing));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
    grid = Grid{{columns, rows}, std::move(values)};
  }
};

struct ScaleGrid {
  In<Grid> grid;
  Out<Grid> scaled;
  double factor = 2;

  static void declare(NodeDecl<ScaleGrid>& d) {
    d.id("acme.image.ScaleGrid", 1).summary("Multiplies the numbers of a grid.");
    d.input("grid", &ScaleGrid::grid).doc("any grid");
    d.output("grid", &ScaleGrid::scaled).doc("of the same size");
    d.param("factor", &ScaleGrid::factor).unit("1").at_least(0).doc("0 gives zeros");
  }
  void run(RunContext&) {
    std::vector<double> values(grid->values.begin(), grid->values.end());
    for (double& value : values) value *= factor;
    scaled = Grid{grid->size, std::move(values)};
  }
};

}  // namespace acme

BALLFLOW_PLUGIN("grid", "2.0.0", (node_entries<acme::MakeGrid, acme::ScaleGrid>()),
                type_entries<acme::Grid>())
