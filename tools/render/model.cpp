#include "model.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace ballflow::render {

static_assert(std::endian::native == std::endian::little);

Vector normalised(Vector a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? 1 / length * a : Vector{0, 0, 1};
}

namespace {

template <class T>
double read_as(std::istream& in) {
  T value{};
  in.read(reinterpret_cast<char*>(&value), sizeof(T));
  return static_cast<double>(value);
}

using Reader = double (*)(std::istream&);

Reader reader_of(const std::string& type) {
  static const std::map<std::string, Reader> readers = {
      {"char", read_as<std::int8_t>},     {"int8", read_as<std::int8_t>},
      {"uchar", read_as<std::uint8_t>},   {"uint8", read_as<std::uint8_t>},
      {"short", read_as<std::int16_t>},   {"int16", read_as<std::int16_t>},
      {"ushort", read_as<std::uint16_t>}, {"uint16", read_as<std::uint16_t>},
      {"int", read_as<std::int32_t>},     {"int32", read_as<std::int32_t>},
      {"uint", read_as<std::uint32_t>},   {"uint32", read_as<std::uint32_t>},
      {"float", read_as<float>},          {"float32", read_as<float>},
      {"double", read_as<double>},        {"float64", read_as<double>},
  };
  const auto found = readers.find(type);
  if (found == readers.end()) throw std::runtime_error("unknown type \"" + type + "\" in the header");
  return found->second;
}

struct Property {
  std::string name;
  Reader count = nullptr;  // of a list
  Reader value = nullptr;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

std::vector<Element> read_header(std::istream& in) {
  std::vector<Element> elements;
  std::string line, word;
  std::getline(in, line);
  if (line != "ply") throw std::runtime_error("not a PLY file");
  while (std::getline(in, line) && line != "end_header") {
    std::istringstream words(line);
    words >> word;
    if (word == "format") {
      words >> word;
      if (word != "binary_little_endian")
        throw std::runtime_error("only binary little-endian PLY files are read");
    } else if (word == "element") {
      Element element;
      words >> element.name >> element.count;
      elements.push_back(element);
    } else if (word == "property" && !elements.empty()) {
      Property property;
      std::string type;
      words >> type;
      if (type == "list") {
        words >> type;
        property.count = reader_of(type);
        words >> type;
      }
      property.value = reader_of(type);
      words >> property.name;
      elements.back().properties.push_back(property);
    }
  }
  if (!in) throw std::runtime_error("the header does not end");
  return elements;
}

std::uint32_t index_of(double value, const Model& model) {
  if (!(value >= 0 && value < static_cast<double>(model.vertices.size()))) {
    throw std::runtime_error("a vertex index is out of range");
  }
  return static_cast<std::uint32_t>(value);
}

Model read_model(std::istream& in) {
  Model model;
  for (const Element& element : read_header(in)) {
    for (std::size_t i = 0; i < element.count; ++i) {
      std::map<std::string, std::vector<double>> row;
      for (const Property& property : element.properties) {
        const double count = property.count != nullptr ? property.count(in) : 1;
        std::vector<double>& values = row[property.name];
        for (double k = 0; k < count && in; ++k) values.push_back(property.value(in));
      }
      if (!in) throw std::runtime_error("the file ends inside element \"" + element.name + "\"");
      if (element.name == "vertex") {
        model.vertices.push_back({row.at("x").at(0), row.at("y").at(0), row.at("z").at(0)});
        if (row.contains("radius")) model.radii.push_back(row["radius"].at(0));
      } else if (element.name == "face") {
        const auto& corners = row.contains("vertex_indices") ? row["vertex_indices"] : row.at("vertex_index");
        auto& polygon = model.polygons.emplace_back();
        for (const double corner : corners) polygon.push_back(index_of(corner, model));
      } else if (element.name == "edge") {
        model.edges.push_back(
            {index_of(row.at("vertex1").at(0), model), index_of(row.at("vertex2").at(0), model)});
      }
    }
  }
  return model;
}

}  // namespace

Model read_ply(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path + ": cannot be read");
  try {
    return read_model(in);
  } catch (const std::out_of_range&) {
    throw std::runtime_error(path + ": lacks x, y, z, vertex_indices, vertex1 or vertex2");
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace ballflow::render
