// A registry of toy nodes for tests of the engine that need no geometry and no node library.
#pragma once

#include <string>

#include "ballflow/registry.hpp"

namespace ballflow::test {

/// Types Points, Balls, Cover (version 1; fields remaining and gap) and the nodes
///   Load    -> points              file (required, file), scale (number > 0, default 1), mode (choice fast |
///   exact) Grow    points [, extra] -> balls   epsilon (number 0..100, default 0.5), steps (integer 1..10,
///   default 3),
///                                       closed (boolean), label (string)
///   Match   balls, points -> cover, rest (Balls)
///   Trim    cover -> cover              keep (number 0..1, required)
///   Show    balls -> (nothing)
inline Registry toy_registry() {
  Registry registry;
  for (const char* type : {"Points", "Balls"}) {
    registry.add(parse_type_declaration(std::string("{\"id\":\"") + type +
                                        R"(","version":1,"doc":"toy","arrays":[],"summary":[]})"));
  }
  registry.add(parse_type_declaration(R"({"id":"Cover","version":1,"doc":"toy","arrays":[],"summary":[
    {"name":"remaining","doc":"what is not covered"},{"name":"gap","doc":"a fraction"}]})"));
  registry.add(
      parse_node_declaration(R"({"id":"Load","version":1,"summary":"Read points.","doc":"","avoid_when":"",
    "cites":[],"libraries":{},"uses_seed":false,"inputs":[],
    "outputs":[{"name":"points","type":"Points","type_version":1,"doc":"n points"}],
    "params":[{"name":"file","kind":"file","required":true,"doc":"the file to read"},
              {"name":"scale","kind":"number","default":1.0,"exclusive_minimum":0,"doc":"factor","unit":"1"},
              {"name":"mode","kind":"choice","default":"fast","doc":"how","choices":[
                 {"value":"fast","doc":"quick"},{"value":"exact","doc":"slow"}]}]})"));
  registry.add(
      parse_node_declaration(R"({"id":"Grow","version":2,"summary":"Grow points.","doc":"","avoid_when":"",
    "inputs":[{"name":"points","type":"Points","type_version":1,"doc":"n points"},
              {"name":"extra","type":"Points","type_version":1,"doc":"more points","optional":true}],
    "outputs":[{"name":"balls","type":"Balls","type_version":1,"doc":"n balls"}],
    "params":[{"name":"epsilon","kind":"number","default":0.5,"minimum":0,"maximum":100,"unit":"%","doc":"growth"},
              {"name":"steps","kind":"integer","default":3,"minimum":1,"maximum":10,"doc":"rounds"},
              {"name":"closed","kind":"boolean","default":false,"doc":"closed balls"},
              {"name":"label","kind":"string","default":"","doc":"any text"}]})"));
  registry.add(parse_node_declaration(R"({"id":"Match","version":1,"summary":"Match.","doc":"",
    "inputs":[{"name":"balls","type":"Balls","type_version":1,"doc":"n balls"},
              {"name":"points","type":"Points","type_version":1,"doc":"n points"}],
    "outputs":[{"name":"cover","type":"Cover","type_version":1,"doc":"who covers whom"},
               {"name":"rest","type":"Balls","type_version":1,"doc":"what covers nothing"}],"params":[]})"));
  registry.add(parse_node_declaration(R"({"id":"Trim","version":1,"summary":"Trim.","doc":"",
    "inputs":[{"name":"cover","type":"Cover","type_version":1,"doc":"a cover"}],
    "outputs":[{"name":"cover","type":"Cover","type_version":1,"doc":"a smaller cover"}],
    "params":[{"name":"keep","kind":"number","required":true,"minimum":0,"maximum":1,"doc":"share that stays"}]})"));
  registry.add(parse_node_declaration(R"({"id":"Show","version":1,"summary":"Show.","doc":"",
    "inputs":[{"name":"balls","type":"Balls","type_version":1,"doc":"n balls"}],"outputs":[],"params":[]})"));
  return registry;
}

}  // namespace ballflow::test
