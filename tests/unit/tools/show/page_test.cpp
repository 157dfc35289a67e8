#include "show/page/page.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <set>

#include "ballflow/error.hpp"
#include "sealed.hpp"
#include "show/page/layer_json.hpp"
#include "toy_nodes.hpp"

namespace ballflow::show {
namespace {

using namespace geometry;

const std::string page_template = "<head></head>\n<!-- ballflow data -->\n<script>program</script>\n";

std::vector<std::uint8_t> from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0, have = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    have += 6;
    if (have < 8) continue;
    have -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> have));
  }
  return bytes;
}

/// The numbers of a block as little-endian words, by the grammar in blocks.hpp.
std::vector<std::uint32_t> words_of(const Block& block) {
  const std::vector<std::uint8_t> packed = from_base64(block.base64);
  const std::size_t size = block.type == Block::Type::u8 ? 1 : 4;
  std::vector<std::uint8_t> bytes(block.count * size);
  uLongf length = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &length, packed.data(), packed.size()), Z_OK);
  EXPECT_EQ(length, bytes.size());
  std::vector<std::uint32_t> words(block.count);
  for (std::size_t i = 0; i < block.count; ++i) {
    for (std::size_t byte = 0; byte < size; ++byte)
      words[i] |= std::uint32_t{bytes[byte * block.count + i]} << 8 * byte;
  }
  return words;
}

std::vector<float> floats_of(const Block& block) {
  std::vector<float> values;
  for (const std::uint32_t word : words_of(block)) {
    values.emplace_back();
    std::memcpy(&values.back(), &word, sizeof word);
  }
  return values;
}

std::vector<std::uint32_t> integers_of(const Block& block) {
  std::vector<std::uint32_t> values;
  std::uint32_t value = 0;
  for (const std::uint32_t word : words_of(block)) {
    value += word % 2 == 0 ? word / 2 : -(word / 2) - 1;
    values.push_back(value);
  }
  return values;
}

Balls some_balls(std::size_t n, double far = 0) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    centers.push_back({far + std::sqrt(x), x / 7, -x * x});
    radii.push_back(1 + x / 3);
  }
  Balls balls;
  balls.centers = centers;
  balls.radii = radii;
  return balls;
}

Layer ball_layer(std::size_t n, double far = 0) {
  const Balls balls = some_balls(n, far);
  Layer layer;
  layer.name = "balls";
  layer.shape = Shape::balls;
  layer.vertices = balls.centers;
  layer.radii = balls.radii;
  layer.attributes = {{"radius", "model units", {}, true, {balls.radii.begin(), balls.radii.end()}}};
  return layer;
}

/// The JSON in a page, as a browser finds it.
nlohmann::json scene_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"ballflow-scene\">";
  const std::size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

PageSources sources(std::function<ArtifactPtr(const Digest&)> load) {
  PageSources all;
  all.load = std::move(load);
  all.describe = [](const OutputEntry& output) { return "a " + output.type; };
  return all;
}

PageSources no_cache() {
  return sources([](const Digest&) { return nullptr; });
}

TEST(blocks, hold_floats_integers_and_bytes) {
  Blocks blocks;
  const std::vector<float> floats = {0, -1.5F, 3e-9F, 7e20F, -0.0F};
  const std::vector<std::uint32_t> integers = {5, 4, 4294967295U, 0, 2147483648U, 7};
  const std::vector<std::uint8_t> bytes = {0, 255, 3};
  blocks.add(std::span<const float>(floats));
  blocks.add(std::span<const std::uint32_t>(integers));
  blocks.add(std::span<const std::uint8_t>(bytes));
  blocks.add(std::span<const std::uint8_t>());
  ASSERT_EQ(blocks.all().size(), 4u);
  EXPECT_EQ(floats_of(blocks.all()[0]), floats);
  EXPECT_EQ(integers_of(blocks.all()[1]), integers);
  EXPECT_EQ(words_of(blocks.all()[2]), (std::vector<std::uint32_t>{0, 255, 3}));
  EXPECT_EQ(words_of(blocks.all()[3]), std::vector<std::uint32_t>{});
}

TEST(blocks, keep_equal_arrays_once_and_tell_types_apart) {
  Blocks blocks;
  const std::vector<float> floats = {0, 0};
  const std::vector<std::uint32_t> integers = {0, 0};
  const std::size_t first = blocks.add(std::span<const float>(floats));
  EXPECT_NE(blocks.add(std::span<const std::uint32_t>(integers)), first);
  EXPECT_EQ(blocks.add(std::span<const float>(floats)), first);
  EXPECT_EQ(blocks.all().size(), 2u);
}

TEST(blocks, are_forgotten_from_the_end) {
  Blocks blocks;
  const std::vector<float> a = {1}, b = {2};
  blocks.add(std::span<const float>(a));
  const std::size_t bytes = blocks.bytes();
  blocks.add(std::span<const float>(b));
  blocks.shrink(1);
  EXPECT_EQ(blocks.bytes(), bytes);
  EXPECT_EQ(blocks.add(std::span<const float>(b)), 1u);
  EXPECT_EQ(floats_of(blocks.all()[1]), b);
}

TEST(layer_json, keeps_the_digits_of_a_model_that_is_far_from_the_origin) {
  const Layer layer = ball_layer(50, 1e7);
  Blocks blocks;
  Json chains = Json::array();
  const Json json = layer_json(layer, blocks, chains);
  const std::vector<float> vertices = floats_of(blocks.all()[json.at("vertices").get<std::size_t>()]);
  ASSERT_EQ(vertices.size(), 150u);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(json.at("centre")[0].get<double>() + vertices[3 * i], layer.vertices[i].x, 1e-6);
    EXPECT_NEAR(json.at("centre")[2].get<double>() + vertices[3 * i + 2], layer.vertices[i].z, 1e-4);
  }
  EXPECT_EQ(json.at("count"), 50);
  EXPECT_NEAR(json.at("lower")[0].get<double>(), 1e7 + 7 - (1 + 49 / 3.0), 1e-6)
      << "with the radius of the last ball";
}

TEST(layer_json, shares_vertices_of_balls_that_differ_in_radius_alone) {
  Layer inner = ball_layer(20), grown = inner;
  std::vector<double> radii(inner.radii.begin(), inner.radii.end());
  for (double& r : radii) r += 100;
  grown.radii = radii;
  Blocks blocks;
  Json chains = Json::array();
  const Json a = layer_json(inner, blocks, chains), b = layer_json(grown, blocks, chains);
  EXPECT_TRUE(chains.empty());
  EXPECT_EQ(a.at("vertices"), b.at("vertices"));
  EXPECT_NE(a.at("radii"), b.at("radii"));
  EXPECT_EQ(a.at("radii"), a.at("attributes")[0].at("values")) << "the attribute radius is the radii";
}

TEST(layer_json, describes_attributes_by_range_or_by_counts) {
  Layer layer;
  layer.name = "complex";
  layer.shape = Shape::triangles;
  layer.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  layer.triangles = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}};
  layer.attributes = {{"kind", "", {"sheet", "wall", "none"}, false, {1, 0, 1}},
                      {"height", "mm", {}, true, {0.5, -2, 4}},
                      {"order", "", {}, true, {0, 1, 7}}};
  Blocks blocks;
  Json chains = Json::array();
  const Json json = layer_json(layer, blocks, chains);
  EXPECT_EQ(integers_of(blocks.all()[json.at("triangles").get<std::size_t>()]),
            (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0, 1, 2, 0}));
  const Json& kind = json.at("attributes")[0];
  EXPECT_EQ(kind.at("counts"), (Json{1, 2, 0}));
  EXPECT_EQ(kind.at("per"), "element");
  EXPECT_EQ(words_of(blocks.all()[kind.at("values").get<std::size_t>()]),
            (std::vector<std::uint32_t>{1, 0, 1}));
  const Json& height = json.at("attributes")[1];
  EXPECT_EQ(height.at("min"), -2);
  EXPECT_EQ(height.at("max"), 4);
  EXPECT_EQ(height.at("unit"), "mm");
  EXPECT_EQ(floats_of(blocks.all()[height.at("values").get<std::size_t>()]),
            (std::vector<float>{0.5F, -2, 4}));
  const Json& order = json.at("attributes")[2];
  EXPECT_EQ(integers_of(blocks.all()[order.at("values").get<std::size_t>()]),
            (std::vector<std::uint32_t>{0, 1, 7}));
}

TEST(page, of_an_artifact_has_its_layers_in_place_of_the_mark) {
  const Registry registry;
  Page page(registry, default_page_bytes);
  page.add_artifact("balls.safetensors", test::sealed(some_balls(3)));
  page.pack(no_cache());
  EXPECT_TRUE(page.left_out().empty());
  EXPECT_EQ(page.layers(), 1u);
  const std::string html = page.html(page_template, "1.2.3");
  EXPECT_EQ(html.find("ballflow data"), std::string::npos);
  EXPECT_TRUE(html.starts_with("<head></head>\n<script"));
  EXPECT_TRUE(html.ends_with("</script>\n\n<script>program</script>\n"));
  const nlohmann::json scene = scene_of(html);
  EXPECT_EQ(scene.at("version"), "1.2.3");
  const std::string digest = scene.at("loose")[0].at("digest");
  const nlohmann::json& artifact = scene.at("artifacts").at(digest);
  EXPECT_EQ(artifact.at("words"), "a Balls");
  EXPECT_EQ(artifact.at("layers")[0].at("count"), 3);
  for (std::size_t i = 0; i < scene.at("blocks").size(); ++i)
    EXPECT_NE(html.find("id=\"block-" + std::to_string(i) + "\""), std::string::npos);
}

TEST(page, says_what_it_leaves_out_to_stay_small_and_keeps_what_comes_first) {
  const Registry registry;
  Page page(registry, 8000);
  page.add_artifact("small", test::sealed(some_balls(10)));
  page.add_artifact("large", test::sealed(some_balls(5000)));
  page.pack(no_cache());
  ASSERT_EQ(page.left_out().size(), 1u);
  EXPECT_EQ(page.left_out()[0], "large: left out: the page would be larger than 8 kB");
  EXPECT_EQ(page.layers(), 1u);
  const nlohmann::json scene = scene_of(page.html(page_template, ""));
  EXPECT_EQ(scene.at("left_out").size(), 1u);
}

RunRecord record(const nlohmann::json& report) { return {"20261122T070000.000-00000000-0000", "r", report}; }

nlohmann::json output(const ArtifactPtr& artifact) {
  return {{"type", artifact->type()},
          {"digest", artifact->digest().hex()},
          {"bytes", artifact->file_size()},
          {"summary", nlohmann::json::parse(artifact->summary())}};
}

TEST(page, of_a_sweep_has_a_variant_per_combination_and_says_what_the_cache_lost) {
  const ArtifactPtr few = test::sealed(some_balls(2)), many = test::sealed(some_balls(5));
  nlohmann::json report = {{"run", "r"}, {"graph", "g.json"}, {"status", "ok"}, {"axes", {"epsilon"}}};
  const auto node = [](const nlohmann::json& outputs) {
    return nlohmann::json{{"type", "Grow"},     {"status", "run"},
                          {"seconds", 0.5},     {"params", {{"epsilon", 1}}},
                          {"outputs", outputs}, {"inputs", {{"points", "load.points"}}}};
  };
  report["nodes"] = {{"[epsilon=1]/grow", node({{"balls", output(few)}})},
                     {"[epsilon=2]/grow", node({{"balls", output(many)}})}};
  report["outputs"] = {{"epsilon=1/balls", output(few)}, {"epsilon=2/balls", output(many)}};
  report["outputs"]["epsilon=1/balls"]["from"] = "[epsilon=1]/grow.balls";
  for (const char* number : {"1", "2"}) {
    const std::string name = std::string("epsilon=") + number;
    report["variants"].push_back({{"name", name},
                                  {"params", {{"epsilon", std::stoi(number)}}},
                                  {"nodes", {"[" + name + "]/grow", "not/there"}}});
  }
  const Registry registry = test::toy_registry();
  Page page(registry, default_page_bytes);
  page.add_run(record(report));
  page.pack(sources([&](const Digest& digest) { return digest == few->digest() ? few : nullptr; }));
  EXPECT_EQ(page.left_out(),
            std::vector<std::string>{"balls: not in the cache any more; the next run makes it again"});
  const nlohmann::json scene = scene_of(page.html(page_template, ""));
  ASSERT_EQ(scene.at("variants").size(), 2u);
  const nlohmann::json& second = scene.at("variants")[1];
  EXPECT_EQ(second.at("values"), (nlohmann::json{{"epsilon", 2}}));
  EXPECT_EQ(second.at("nodes").size(), 1u);
  EXPECT_EQ(second.at("outputs")[0].at("digest"), many->digest().hex());
  const nlohmann::json& grow = scene.at("graphs")[0].at("nodes")[second.at("nodes")[0].get<std::size_t>()];
  EXPECT_EQ(grow.at("name"), "grow");
  EXPECT_EQ(grow.at("seconds"), 0.5);
  EXPECT_EQ(scene.at("types").at("Grow").at("params").at("epsilon").at("unit"), "%");
  EXPECT_TRUE(scene.at("artifacts").at(many->digest().hex()).contains("missing"));
  EXPECT_TRUE(scene.at("artifacts").at(few->digest().hex()).contains("layers"));
}

TEST(page, takes_any_report_and_lets_no_text_end_its_element) {
  const nlohmann::json report = {
      {"run", "r"},
      {"graph", "</script><script>alert(1)</script>"},
      {"nodes", {{"<!--", {{"type", 3}, {"params", "text"}, {"outputs", {{"x", 4}}}}}, {"b", "no object"}}},
      {"variants", {7, {{"name", 3}}}},
      {"outputs", {{"a", nullptr}}},
      {"axes", 5}};
  const Registry registry;
  Page page(registry, default_page_bytes);
  page.add_run(record(report));
  page.pack(no_cache());
  const std::string html = page.html(page_template, "");
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<!--"), std::string::npos);
  const nlohmann::json scene = scene_of(html);
  EXPECT_EQ(scene.at("graphs")[0].at("name"), "</script><script>alert(1)</script>");
  EXPECT_EQ(scene.at("graphs")[0].at("nodes")[0].at("path"), "<!--");
}

TEST(page, refuses_to_be_larger_than_it_may_be_without_any_artifact) {
  const Registry registry;
  Page page(registry, 100);
  page.add_run(record({{"run", "r"}, {"graph", "g"}, {"nodes", {{"a", {{"type", "A"}}}}}}));
  page.pack(no_cache());
  try {
    page.html(page_template, "");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

TEST(page, of_a_graph_has_nodes_edges_and_no_artifacts) {
  const Registry registry = test::toy_registry();
  const Dag dag = parse_graph(R"({"doc": "d", "nodes": {
      "load": {"type": "Load", "params": {"file": "/dev/null"}},
      "grow": {"type": "Grow", "inputs": {"points": "load.points"}}},
    "outputs": {"balls": "grow.balls"},
    "sweep": {"axes": {"grow.epsilon": [1, 2]}}})",
                              "g.json", registry);
  Page page(registry, default_page_bytes);
  page.add_graph(dag, {});
  const nlohmann::json scene = scene_of(page.html(page_template, ""));
  EXPECT_EQ(scene.at("graphs")[0].at("nodes").size(), 3u);
  ASSERT_EQ(scene.at("variants").size(), 2u);
  const nlohmann::json& variant = scene.at("variants")[1];
  EXPECT_EQ(variant.at("nodes").size(), 2u);
  ASSERT_EQ(variant.at("outputs").size(), 1u);
  EXPECT_EQ(variant.at("outputs")[0].at("name"), "balls");
  std::set<std::string> inputs;
  for (const auto& node : scene.at("graphs")[0].at("nodes"))
    for (const auto& [port, from] : node.at("inputs").items()) inputs.insert(from);
  EXPECT_EQ(inputs, std::set<std::string>{"load.points"});
  EXPECT_TRUE(scene.at("artifacts").empty());
}

}  // namespace
}  // namespace ballflow::show
