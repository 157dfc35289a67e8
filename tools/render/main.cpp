// ballflow-render: a picture of exported results, side by side, without a graphics card.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "picture.hpp"

int main(int argc, char** argv) {
  using namespace ballflow::render;
  CLI::App app{
      "Draws PLY files written by `ballflow export` side by side, in one scale, into a PNG file.\n"
      "Points become beads, balls spheres; radii give the colour, from violet (small) to yellow."};
  std::string output;
  std::vector<std::string> files;
  PictureOptions options;
  app.add_option("output", output, "picture to write (.png)")->required();
  app.add_option("files", files, "binary PLY files: points, balls, meshes, medial axes")->required();
  app.add_option("--from", options.from, "direction from the models to the viewer")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--up", options.up, "direction that points up in the picture")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--height", options.height, "pixels")->check(CLI::Range(16, 8192))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Model> models;
    for (const std::string& file : files) models.push_back(read_ply(file));
    write_png(picture(models, options), output);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ballflow-render: %s\n", error.what());
    return 2;
  }
}
