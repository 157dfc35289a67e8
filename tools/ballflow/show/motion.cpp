#include "show/motion.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "ballflow/error.hpp"
#include "ballflow/text.hpp"
#include "exact/exponential.hpp"

namespace ballflow::show {
namespace {

using geometry::Pose;
using geometry::Vec3;

/// The point of a frame that is at p in the model.
Vec3 in_frame(const Pose& frame, Vec3 p) {
  const Vec3 d = p - Vec3{frame[9], frame[10], frame[11]};
  return {frame[0] * d.x + frame[3] * d.y + frame[6] * d.z, frame[1] * d.x + frame[4] * d.y + frame[7] * d.z,
          frame[2] * d.x + frame[5] * d.y + frame[8] * d.z};
}

void move(Layer& layer, std::string_view joint, double value) {
  if (layer.chain == nullptr) return;
  std::vector<double> values;
  bool any = false;
  for (const Chain::Joint& each : layer.chain->joints) values.push_back(each.value);
  const std::vector<double> given = values;
  const std::vector<Pose> before = frame_poses(*layer.chain, values);
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (layer.chain->joints[j].name != joint) continue;
    values[j] = value;
    any = true;
  }
  if (!any) return;
  const std::vector<Pose> after = frame_poses(*layer.chain, values);
  std::vector<Vec3> vertices;
  vertices.reserve(layer.vertices.size());
  for (std::size_t i = 0; i < layer.vertices.size(); ++i) {
    const std::size_t frame = layer.frames[i];
    vertices.push_back(moved(after[frame], in_frame(before[frame], layer.vertices[i])));
  }
  layer.vertices = std::move(vertices);
  if (layer.radii.empty()) return;
  const std::vector<double> small = frame_growths(*layer.chain, given);
  const std::vector<double> large = frame_growths(*layer.chain, values);
  std::vector<double> radii;
  radii.reserve(layer.radii.size());
  for (std::size_t i = 0; i < layer.radii.size(); ++i) {
    const std::size_t frame = layer.frames[i];
    radii.push_back(layer.radii[i] * geometry::exponential(large[frame] - small[frame]));
  }
  layer.radii = std::move(radii);
}

}  // namespace

Chain::Joint joint_named(const std::vector<Layer>& layers, const std::string& name) {
  std::vector<std::string> known;
  for (const Layer& layer : layers) {
    if (layer.chain == nullptr) continue;
    for (const Chain::Joint& joint : layer.chain->joints) {
      if (joint.name == name) return joint;
      if (std::find(known.begin(), known.end(), joint.name) == known.end()) known.push_back(joint.name);
    }
  }
  if (known.empty())
    throw Error(ExitCode::usage, "nothing moves in this picture", "robots and models of shapes have joints");
  std::string all;
  for (const std::string& each : known) all += (all.empty() ? "" : ", ") + each;
  throw Error(ExitCode::usage, "there is no joint \"" + name + "\"", "the joints are " + all);
}

std::vector<Layer> with_joint(const std::vector<Layer>& layers, std::string_view joint, double value) {
  std::vector<Layer> all = layers;
  for (Layer& layer : all) move(layer, joint, value);
  return all;
}

}  // namespace ballflow::show
