// What the SDK makes of declarations, and what it believes of artifacts and parameters that others hand over.
#include "ballflow/sdk.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "ballflow/node_decl.hpp"
#include "ballflow/registry.hpp"
#include "list.hpp"
#include "run_nodes.hpp"

namespace sdk_test {

using namespace ballflow;

struct Cloud {
  std::array<double, 2> origin{};
  toy::List<std::array<double, 3>> points;
  toy::List<std::int32_t> offsets;
};

struct Deep {
  struct Inner {
    float ratio = 0.25f;
    enum class Side { left, right } side = Side::right;
  };
  struct Options {
    std::int32_t small = 7;
    std::uint16_t tiny = 3;
    std::uint64_t large = 5;
    Inner inner;
  };
  InList<Cloud> clouds;
  Out<Cloud> all;
  Options options;
  static void declare(NodeDecl<Deep>& d);
  void run(RunContext& context);
};

}  // namespace sdk_test

template <>
struct ballflow::TypeOf<sdk_test::Cloud> {
  static void declare(TypeDecl<sdk_test::Cloud>& d) {
    d.id("test.Cloud", 1).doc("Points.");
    d.scalar("origin", &sdk_test::Cloud::origin).doc("two numbers");
    d.array("points", &sdk_test::Cloud::points).length("n").doc("coordinates");
    d.array("offsets", &sdk_test::Cloud::offsets).length("n+1").optional().doc("offsets");
    d.summary("count", "how many");
    d.summarize([](const sdk_test::Cloud& v) { return Summary{{"count", v.points.size()}}; });
  }
};

namespace sdk_test {

void Deep::declare(NodeDecl<Deep>& d) {
  d.id("test.Deep", 1).summary("Joins clouds.");
  d.input("clouds", &Deep::clouds).doc("in order");
  d.output("all", &Deep::all).doc("their points, in order");
  d.param("small", &Deep::options, &Options::small).unit("1").at_least(0).doc("32 bits");
  d.param("tiny", &Deep::options, &Options::tiny).unit("1").above(0).doc("16 bits without sign");
  d.param("large", &Deep::options, &Options::large).unit("1").doc("64 bits without sign");
  d.param("ratio", &Deep::options, &Options::inner, &Inner::ratio).unit("1").doc("two structs deep");
  d.choice("side", &Deep::options, &Options::inner, &Inner::side,
           {{Inner::Side::left, "left", "l"}, {Inner::Side::right, "right", "r"}})
      .doc("two structs deep");
}

void Deep::run(RunContext& context) {
  std::vector<std::array<double, 3>> points;
  for (const Cloud& cloud : clouds)
    points.insert(points.end(), cloud.points.data(), cloud.points.data() + cloud.points.size());
  context.info("small " + std::to_string(options.small) + " tiny " + std::to_string(options.tiny) +
               " ratio " + std::to_string(options.inner.ratio) +
               (options.inner.side == Inner::Side::left ? " left" : " right"));
  all = Cloud{{}, std::move(points), {}};
}

/// A host that is no engine: hands over what a test wants.
struct Host {
  std::map<std::string, std::vector<bf_artifact>> inputs;
  std::string params, cause, hint, said;
  std::map<std::string, std::string> summaries;
  std::map<std::string, std::vector<double>> values;

  int run(const bf_node* node) {
    bf_run table{};
    table.struct_size = sizeof table;
    table.max_threads = 1;
    table.params = detail::bytes(params);
    table.host = this;
    table.cancelled = [](void*) -> int { return 0; };
    table.progress = [](void*, double) {};
    table.log = [](void* self, std::uint32_t, bf_bytes text) { of(self).said = detail::view(text); };
    table.input_count = [](void* self, bf_bytes port) -> std::uint64_t {
      return of(self).inputs[std::string(detail::view(port))].size();
    };
    table.input = [](void* self, bf_bytes port, std::uint64_t index, bf_artifact* artifact) -> int {
      *artifact = of(self).inputs[std::string(detail::view(port))].at(index);
      return 1;
    };
    table.output = [](void* self, bf_bytes port, const bf_array* arrays, std::uint64_t count,
                      bf_bytes summary) -> int {
      const std::string name(detail::view(port));
      of(self).summaries[name] = detail::view(summary);
      for (std::uint64_t i = 0; i < count; ++i) {
        if (detail::view(arrays[i].name) == "points") {
          const auto* data = static_cast<const double*>(arrays[i].data);
          of(self).values[name].assign(data, data + arrays[i].shape[0] * arrays[i].shape[1]);
        }
        arrays[i].release(arrays[i].owner);
      }
      return 0;
    };
    table.fail = [](void* self, bf_bytes why, bf_bytes what_to_do) {
      of(self).cause = detail::view(why);
      of(self).hint = detail::view(what_to_do);
    };
    return node->run(node->self, &table);
  }
  static Host& of(void* self) { return *static_cast<Host*>(self); }
};

/// Arrays of a struct that a later version of the boundary has made longer.
struct LongArray {
  bf_array array;
  char more[24];
};

struct Clouds {
  std::vector<LongArray> arrays;
  std::vector<double> origin = {0, 0}, points;
  std::vector<std::int32_t> offsets = {0, 1, 2};
  explicit Clouds(std::vector<double> coordinates) : points(std::move(coordinates)) {
    add("origin", BF_F64, {2}, origin.data());
    add("points", BF_F64, {points.size() / 3, 3}, points.data());
  }
  void add(const char* name, std::uint32_t dtype, const std::vector<std::uint64_t>& shape, const void* data) {
    LongArray added{};
    added.array.struct_size = sizeof added;
    added.array.name = detail::bytes(name);
    added.array.dtype = dtype;
    added.array.rank = static_cast<std::uint32_t>(shape.size());
    std::copy(shape.begin(), shape.end(), added.array.shape);
    added.array.data = data;
    arrays.push_back(added);
  }
  bf_artifact raw() const {
    bf_artifact raw{};
    raw.struct_size = sizeof raw;
    raw.arrays = &arrays.data()->array;
    raw.array_count = arrays.size();
    raw.retain = [](void*) {};
    raw.release = [](void*) {};
    return raw;
  }
};

std::string refusal(const Clouds& clouds) {
  try {
    type_decl<Cloud>().read(clouds.raw());
  } catch (const NodeError& error) {
    const std::string text = error.what();
    return text.substr(0, text.find('\n'));
  }
  return "";
}

TEST(sdk, reads_nothing_that_is_not_as_declared) {
  Clouds good({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(refusal(good), "");
  EXPECT_EQ(type_decl<Cloud>().read(good.raw()).points.size(), 2u);
  good.add("offsets", BF_I32, {3}, good.offsets.data());
  EXPECT_EQ(refusal(good), "");

  const std::string start = "an artifact is no valid test.Cloud: array ";
  const auto changed = [&](auto change) {
    Clouds clouds = good;
    change(clouds.arrays);
    return refusal(clouds);
  };
  using Arrays = std::vector<LongArray>;
  EXPECT_EQ(changed([](Arrays& a) { a[1].array.dtype = BF_F32; }),
            start + "\"points\" holds f32, must hold f64");
  EXPECT_EQ(changed([](Arrays& a) { a[1].array.rank = 1; }), start + "\"points\" has rank 1, must have 2");
  EXPECT_EQ(changed([](Arrays& a) { a[1].array.shape[1] = 2; }), start + "\"points\" is 2 wide, must be 3");
  EXPECT_EQ(changed([](Arrays& a) { a[1].array.data = nullptr; }),
            start + "\"points\" has a length and no data");
  EXPECT_EQ(changed([](Arrays& a) { a[0].array.shape[0] = 1; }), start + "\"origin\" is 1 wide, must be 2");
  EXPECT_EQ(changed([](Arrays& a) { a[2].array.shape[0] = 9; }),
            start + "\"offsets\" has length 9, must have 3 (n+1)");
  EXPECT_EQ(changed([](Arrays& a) { a.erase(a.begin() + 1); }), start + "\"points\" is missing");
}

TEST(sdk, knows_the_memory_of_the_run_where_the_engine_tells_it) {
  bf_run raw{};
  raw.struct_size = sizeof raw;
  raw.memory_bytes = std::uint64_t{7} << 40;
  EXPECT_EQ(RunContext(raw).memory_bytes(), raw.memory_bytes);
  raw.struct_size = BF_RUN_MIN_SIZE;  // an older engine; what lies behind its struct is anything
  EXPECT_EQ(RunContext(raw).memory_bytes(), 0u);
}

TEST(sdk, a_list_port_gets_its_artifacts_in_order) {
  const Clouds first({1, 2, 3}), second({4, 5, 6, 7, 8, 9});
  Host host;
  host.params = R"({"large":5,"ratio":0.5,"side":"left","small":-1,"tiny":65535})";
  host.inputs["clouds"] = {second.raw(), first.raw()};
  EXPECT_EQ(host.run(node_entry<Deep>()), BF_OK) << host.cause;
  EXPECT_EQ(host.values["all"], (std::vector<double>{4, 5, 6, 7, 8, 9, 1, 2, 3}));
  EXPECT_EQ(host.summaries["all"], R"({"count":3})");
  EXPECT_EQ(host.said, "small -1 tiny 65535 ratio 0.500000 left");
}

TEST(sdk, an_input_that_is_not_as_declared_fails_the_node_with_its_port) {
  Clouds clouds({1, 2, 3});
  clouds.arrays[1].array.dtype = BF_I64;
  Host host;
  host.params = R"({"large":5,"ratio":0.5,"side":"left","small":1,"tiny":2})";
  host.inputs["clouds"] = {clouds.raw()};
  EXPECT_EQ(host.run(node_entry<Deep>()), BF_FAILED);
  EXPECT_EQ(
      host.cause,
      "input \"clouds\": an artifact is no valid test.Cloud: array \"points\" holds i64, must hold f64");
}

TEST(sdk, parameters_that_do_not_fit_the_member_are_refused) {
  Host host;
  for (const char* params : {R"({"large":5,"ratio":0.5,"side":"left","small":1099511627776,"tiny":2})",
                             R"({"large":5,"ratio":0.5,"side":"middle","small":1,"tiny":2})",
                             R"({"large":5,"ratio":"x","side":"left","small":1,"tiny":2})",
                             R"({"large":5,"ratio":0.5,"side":"left","small":1})", "[]", ""}) {
    host.params = params;
    host.cause.clear();
    EXPECT_EQ(host.run(node_entry<Deep>()), BF_FAILED) << params;
    EXPECT_NE(host.cause, "") << params;
  }
}

TEST(sdk, the_declaration_has_the_range_of_the_member) {
  const NodeDeclaration decl = parse_node_declaration(node_decl<Deep>().json());
  ASSERT_NE(decl.input("clouds"), nullptr);
  EXPECT_TRUE(decl.input("clouds")->list);
  const ParamDecl& small = *decl.param("small");
  EXPECT_EQ(small.default_value, 7);
  EXPECT_EQ(small.minimum, 0.0);
  EXPECT_EQ(small.maximum, 2147483647.0);
  EXPECT_EQ(small.refuse(std::int64_t{1} << 40), "must be at most 2147483647, is 1099511627776");
  EXPECT_EQ(decl.param("tiny")->exclusive_minimum, 0.0);
  EXPECT_EQ(decl.param("tiny")->minimum, std::nullopt) << "the author's bound is the narrower one";
  EXPECT_EQ(decl.param("tiny")->maximum, 65535.0);
  EXPECT_EQ(decl.param("large")->minimum, 0.0);
  EXPECT_EQ(decl.param("large")->maximum, std::nullopt);
  EXPECT_EQ(decl.param("ratio")->default_value, 0.25);
  EXPECT_EQ(decl.param("ratio")->maximum, static_cast<double>(std::numeric_limits<float>::max()));
  EXPECT_EQ(decl.param("side")->default_value, "right");
}

TEST(sdk, texts_cross_the_boundary_as_they_are) {
  struct Echo {
    Out<Cloud> out;
    std::string text = "quote \" backslash \\ \t caf\xc3\xa9";
    static void declare(NodeDecl<Echo>& d) {
      d.id("test.Echo", 1).summary("s");
      d.output("out", &Echo::out).doc("d");
      d.param("text", &Echo::text).doc("d");
    }
    void run(RunContext& context) {
      context.info(text);
      out = Cloud{};
      out.summary("text", text);
      out.summary("list", std::vector<double>{1, 0.5, std::numeric_limits<double>::quiet_NaN()});
      out.summary("nothing", nullptr);
      out.summary("yes", true);
    }
  };
  const NodeDeclaration decl = parse_node_declaration(node_decl<Echo>().json());
  EXPECT_EQ(decl.param("text")->default_value, "quote \" backslash \\ \t caf\xc3\xa9");
  Host host;
  host.params = R"({"text":"\u00e9\ud83d\ude00 \"\\\/\n"})";
  ASSERT_EQ(host.run(node_entry<Echo>()), BF_OK) << host.cause;
  EXPECT_EQ(host.said, "\xc3\xa9\xf0\x9f\x98\x80 \"\\/\n");
  const Json summary = Json::parse(host.summaries["out"]);
  EXPECT_EQ(summary.at("text"), host.said);
  EXPECT_EQ(summary.at("list"), Json::parse("[1.0,0.5,null]"));
  EXPECT_EQ(summary.at("nothing"), nullptr);
  EXPECT_EQ(summary.at("yes"), true);
}

TEST(sdk, tables_of_a_host_program_are_released_with_the_registry) {
  static int released = 0;
  bf_plugin plugin = toy::plugin();
  plugin.owner = &released;
  plugin.release = [](void* owner) { ++*static_cast<int*>(owner); };
  {
    Registry registry;
    registry.add_plugin(plugin, "");
    EXPECT_NE(registry.node("Add"), nullptr);
    EXPECT_EQ(released, 0);
  }
  EXPECT_EQ(released, 1);
}

}  // namespace sdk_test
