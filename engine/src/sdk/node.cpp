#include "ballflow/sdk/node.hpp"

#include <cstring>
#include <memory>
#include <new>

#include "sdk/json_writer.hpp"
#include "sdk/params.hpp"

namespace ballflow::detail {

namespace {

void report(const bf_run& raw, std::string_view cause, std::string_view hint) noexcept {
  raw.fail(raw.host, bytes(cause), bytes(hint));
}

/// Called inside a catch block.
void report_exception(const bf_run& raw) noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    report(raw, "out of memory", "use a smaller input, a smaller epsilon, or a machine with more memory");
  } catch (const std::exception& error) {
    const std::string_view text = error.what();
    const std::size_t split = text.find('\n');
    report(raw, text.substr(0, split), split == std::string_view::npos ? "" : text.substr(split + 1));
  } catch (...) {
    report(raw, "the node threw something that is not an exception", "this is a bug of the node");
  }
}

const char* kind_text(const AnyNodeDecl::Param& param) {
  switch (param.kind) {
    case AnyNodeDecl::Kind::number:
      return "number";
    case AnyNodeDecl::Kind::integer:
      return "integer";
    case AnyNodeDecl::Kind::boolean:
      return "boolean";
    case AnyNodeDecl::Kind::choice:
      return "choice";
    case AnyNodeDecl::Kind::string:
      break;
  }
  return param.file ? "file" : "string";
}

std::string ports_json(const std::vector<AnyNodeDecl::Port>& ports) {
  std::string list;
  for (const AnyNodeDecl::Port& port : ports) {
    list += list.empty() ? "{" : ",{";
    write_json_text(list, "name", port.name);
    write_json_text(list, "type", port.type);
    write_json_value(list, "type_version", std::to_string(port.type_version));
    write_json_text(list, "doc", port.doc);
    if (port.optional) write_json_value(list, "optional", "true");
    if (port.list) write_json_value(list, "list", "true");
    list += '}';
  }
  return "[" + list + "]";
}

void write_range(std::string& json, const AnyNodeDecl::Param& param) {
  std::optional<double> minimum = param.minimum, maximum = param.maximum;
  // Beyond the range that the author gave stands what the member can hold.
  if (param.lowest && !(minimum && *minimum >= *param.lowest) &&
      !(param.exclusive_minimum && *param.exclusive_minimum >= *param.lowest)) {
    minimum = param.lowest;
  }
  if (param.highest && !(maximum && *maximum <= *param.highest) &&
      !(param.exclusive_maximum && *param.exclusive_maximum <= *param.highest)) {
    maximum = param.highest;
  }
  const auto write = [&](const char* name, const std::optional<double>& value) {
    if (!value) return;
    const bool whole = param.kind == AnyNodeDecl::Kind::integer;
    write_json_value(json, name,
                     whole ? std::to_string(static_cast<std::int64_t>(*value)) : json_number(*value));
  };
  write("minimum", minimum);
  write("maximum", maximum);
  write("exclusive_minimum", param.exclusive_minimum);
  write("exclusive_maximum", param.exclusive_maximum);
}

std::string param_json(const AnyNodeDecl::Param& param) {
  std::string json = "{";
  write_json_text(json, "name", param.name);
  write_json_text(json, "kind", kind_text(param));
  if (param.required) {
    write_json_value(json, "required", "true");
  } else {
    write_json_value(json, "default", param.default_value);
  }
  write_json_text(json, "doc", param.doc);
  if (!param.unit.empty()) write_json_text(json, "unit", param.unit);
  write_range(json, param);
  if (!param.hashed) write_json_value(json, "hashed", "false");
  std::string list;
  for (const Choice<std::int64_t>& choice : param.choices) {
    list += list.empty() ? "{" : ",{";
    write_json_text(list, "value", choice.name);
    write_json_text(list, "doc", choice.doc);
    list += '}';
  }
  if (param.kind == AnyNodeDecl::Kind::choice) write_json_value(json, "choices", "[" + list + "]");
  list.clear();
  for (const std::string& scheme : param.schemes) {
    if (!list.empty()) list += ',';
    write_json_string(list, scheme);
  }
  if (!param.schemes.empty()) write_json_value(json, "schemes", "[" + list + "]");
  return json + "}";
}

/// Writes a value into the member of a node. The engine has checked it against the declaration; what does not
/// fit all the same is refused, because the host may be another program.
void set_param(char* member, const AnyNodeDecl::Param& param, const ParamValue& value) {
  const auto refuse = [&param] {
    throw NodeError("parameter \"" + param.name + "\" has a value that its declaration does not allow",
                    "this is a bug of the program that runs the node");
  };
  using Kind = ParamValue::Kind;
  switch (param.kind) {
    case AnyNodeDecl::Kind::boolean: {
      if (value.kind != Kind::boolean) refuse();
      *reinterpret_cast<bool*>(member) = value.boolean;
      return;
    }
    case AnyNodeDecl::Kind::number: {
      if (value.kind != Kind::number && value.kind != Kind::integer) refuse();
      if (param.size == sizeof(float)) {
        *reinterpret_cast<float*>(member) = static_cast<float>(value.number);
      } else {
        *reinterpret_cast<double*>(member) = value.number;
      }
      return;
    }
    case AnyNodeDecl::Kind::integer: {
      if (value.kind != Kind::integer || (param.lowest && value.number < *param.lowest) ||
          (param.highest && value.number > *param.highest)) {
        refuse();
      }
      std::memcpy(member, &value.integer, param.size);  // little-endian: the low bytes come first
      return;
    }
    case AnyNodeDecl::Kind::string: {
      if (value.kind != Kind::string) refuse();
      *reinterpret_cast<std::string*>(member) = value.text;
      return;
    }
    case AnyNodeDecl::Kind::choice: {
      for (const Choice<std::int64_t>& choice : param.choices) {
        if (value.kind != Kind::string || value.text != choice.name) continue;
        std::memcpy(member, &choice.value, param.size);
        return;
      }
      refuse();
    }
  }
}

}  // namespace

AnyNodeDecl::PortRef& AnyNodeDecl::PortRef::doc(std::string_view text) {
  ports_[index_].doc = text;
  return *this;
}
AnyNodeDecl::PortRef& AnyNodeDecl::PortRef::optional() {
  ports_[index_].optional = true;
  return *this;
}

using ParamRef = AnyNodeDecl::ParamRef;
ParamRef& ParamRef::doc(std::string_view text) {
  param().doc = text;
  return *this;
}
ParamRef& ParamRef::unit(std::string_view text) {
  param().unit = text;
  return *this;
}
ParamRef& ParamRef::at_least(double value) {
  param().minimum = value;
  return *this;
}
ParamRef& ParamRef::at_most(double value) {
  param().maximum = value;
  return *this;
}
ParamRef& ParamRef::above(double value) {
  param().exclusive_minimum = value;
  return *this;
}
ParamRef& ParamRef::below(double value) {
  param().exclusive_maximum = value;
  return *this;
}
ParamRef& ParamRef::file() {
  param().file = true;
  return *this;
}
ParamRef& ParamRef::scheme(std::string_view prefix) {
  param().schemes.emplace_back(prefix);
  return *this;
}
ParamRef& ParamRef::required() {
  param().required = true;
  return *this;
}
ParamRef& ParamRef::not_hashed() {
  param().hashed = false;
  return *this;
}

AnyNodeDecl::Port& AnyNodeDecl::add_port(std::vector<Port>& ports, std::string_view name,
                                         const AnyTypeDecl& type, std::size_t offset) {
  Port& port = ports.emplace_back();
  port.name = name;
  port.type = type.type_id();
  port.type_version = type.type_version();
  port.offset = offset;
  return port;
}

AnyNodeDecl::Param& AnyNodeDecl::add_param(std::string_view name, Kind kind, std::string default_value,
                                           std::size_t offset, std::size_t size) {
  Param& param = params_.emplace_back();
  param.name = name;
  param.kind = kind;
  param.default_value = std::move(default_value);
  param.offset = offset;
  param.size = size;
  return param;
}

std::string AnyNodeDecl::json() const {
  std::string json = "{";
  write_json_text(json, "id", id_);
  write_json_value(json, "version", std::to_string(version_));
  write_json_text(json, "summary", text_summary_);
  write_json_text(json, "doc", doc_);
  write_json_text(json, "avoid_when", avoid_when_);
  std::string list;
  for (const Citation& cite : cites_) {
    list += list.empty() ? "{" : ",{";
    write_json_text(list, "key", cite.key);
    write_json_text(list, "where", cite.where);
    list += '}';
  }
  write_json_value(json, "cites", "[" + list + "]");
  std::string libraries = "{";
  for (const auto& [name, version] : libraries_) write_json_text(libraries, name, version);
  write_json_value(json, "libraries", libraries + "}");
  write_json_value(json, "uses_seed", uses_seed_ ? "true" : "false");
  if (memory_) {
    std::string memory = "{";
    write_json_value(memory, "fixed", std::to_string(memory_->first));
    write_json_value(memory, "per_input_byte", json_number(memory_->second));
    write_json_value(json, "memory", memory + "}");
  }
  write_json_value(json, "inputs", ports_json(inputs_));
  write_json_value(json, "outputs", ports_json(outputs_));
  list.clear();
  for (const Param& param : params_) list += (list.empty() ? "" : ",") + param_json(param);
  write_json_value(json, "params", "[" + list + "]");
  return json + "}";
}

void AnyNodeDecl::fill_params(void* node, bf_bytes text) const {
  char* const begin = static_cast<char*>(node);
  const auto params = read_params(view(text));
  for (const Param& param : params_) {
    const auto found = params.find(param.name);
    if (found == params.end())
      throw NodeError("parameter \"" + param.name + "\" was not handed over",
                      "this is a bug of the program that runs the node");
    set_param(begin + param.offset, param, found->second);
  }
}

void AnyNodeDecl::fill(void* node, const bf_run& raw) const {
  char* const begin = static_cast<char*>(node);
  fill_params(node, raw.params);
  for (const Port& port : inputs_) {
    const std::uint64_t count = raw.input_count(raw.host, bytes(port.name));
    if (count > 1 && !port.list)
      throw NodeError(
          "input \"" + port.name + "\" takes one artifact, " + std::to_string(count) + " are connected",
          "connect one of them");
    for (std::uint64_t i = 0; i < count; ++i) {
      bf_artifact artifact{};
      artifact.struct_size = sizeof artifact;
      if (raw.input(raw.host, bytes(port.name), i, &artifact) == 0) continue;
      try {
        port.read(begin + port.offset, artifact);
      } catch (const NodeError& error) {
        throw std::runtime_error("input \"" + port.name + "\": " + error.what());
      }
    }
  }
}

void AnyNodeDecl::hand_over(const void* node, const bf_run& raw) const {
  for (const Port& port : outputs_) {
    OutArrays arrays;
    Summary summary;
    if (!port.write(static_cast<const char*>(node) + port.offset, arrays, summary))
      throw std::logic_error("the node did not set its output \"" + port.name + "\"");
    const std::string text = summary.text();
    if (raw.output(raw.host, bytes(port.name), arrays.arrays().data(), arrays.arrays().size(), bytes(text)) !=
        0)
      throw RunCancelled();  // the engine has recorded why it refused the output
  }
}

std::vector<NamedFile> AnyNodeDecl::files(bf_bytes params) const noexcept {
  try {
    const std::unique_ptr<void, void (*)(void*)> node(operations_.make(), operations_.destroy);
    fill_params(node.get(), params);
    return operations_.files(node.get());
  } catch (...) {
    return {};
  }
}

int AnyNodeDecl::run(const bf_run& raw) const noexcept {
  if (raw.struct_size < BF_RUN_MIN_SIZE) return BF_FAILED;  // fail() may be what is missing
  try {
    const std::unique_ptr<void, void (*)(void*)> node(operations_.make(), operations_.destroy);
    RunContext context(raw);
    fill(node.get(), raw);
    operations_.run(node.get(), context);
    hand_over(node.get(), raw);
    return BF_OK;
  } catch (const RunCancelled&) {
    return BF_CANCELLED;
  } catch (...) {
    // Whatever an algorithm throws to get out of a cancelled computation is not a failure.
    if (raw.cancelled(raw.host) != 0) return BF_CANCELLED;
    report_exception(raw);
  }
  return BF_FAILED;
}

}  // namespace ballflow::detail
