#include "ballflow/sdk/type.hpp"

#include <cstring>

#include "ballflow/sdk/error.hpp"
#include "sdk/json_writer.hpp"

namespace ballflow::detail {

namespace {

struct Dtype {
  const char* name;
  std::size_t size;
};

Dtype dtype_info(std::uint32_t dtype) {
  switch (dtype) {
    case BF_F64:
      return {"f64", 8};
    case BF_F32:
      return {"f32", 4};
    case BF_I64:
      return {"i64", 8};
    case BF_I32:
      return {"i32", 4};
    case BF_U32:
      return {"u32", 4};
    case BF_U16:
      return {"u16", 2};
    case BF_U8:
      return {"u8", 1};
    default:
      return {"an unknown type", 0};
  }
}

[[noreturn]] void refuse(const std::string& type, const std::string& array, const std::string& why) {
  throw NodeError("an artifact is no valid " + type + ": array \"" + array + "\" " + why,
                  "it was made by another version of the library that declares the type: make it again");
}

/// "n+1" -> ("n", 1)
std::pair<std::string_view, std::uint64_t> length_name(std::string_view text) {
  const std::size_t plus = text.find('+');
  if (plus == std::string_view::npos) return {text, 0};
  std::uint64_t more = 0;
  for (const char c : text.substr(plus + 1)) more = more * 10 + static_cast<std::uint64_t>(c - '0');
  return {text.substr(0, plus), more};
}

const bf_array* find(const bf_artifact& artifact, const std::string& name) {
  const auto* at = reinterpret_cast<const char*>(artifact.arrays);
  for (std::uint64_t i = 0; i < artifact.array_count; ++i) {
    const auto* array = reinterpret_cast<const bf_array*>(at + i * artifact.arrays->struct_size);
    if (view(array->name) == name) return array;
  }
  return nullptr;
}

/// Of the first dimension; 1 for one number. Throws where the array is not as the field says.
std::size_t checked_length(const std::string& type, const AnyTypeDecl::Field& field, const bf_array& array) {
  const Dtype dtype = dtype_info(field.dtype);
  if (array.dtype != field.dtype)
    refuse(type, field.name,
           std::string("holds ") + dtype_info(array.dtype).name + ", must hold " + dtype.name);
  const std::uint32_t rank = (field.scalar ? 0 : 1) + (field.width != 0 ? 1 : 0);
  if (array.rank != rank)
    refuse(type, field.name,
           "has rank " + std::to_string(array.rank) + ", must have " + std::to_string(rank));
  if (field.width != 0 && array.shape[rank - 1] != field.width) {
    refuse(type, field.name,
           "is " + std::to_string(array.shape[rank - 1]) + " wide, must be " + std::to_string(field.width));
  }
  const std::uint64_t length = field.scalar ? 1 : array.shape[0];
  if (length != 0 && array.data == nullptr) refuse(type, field.name, "has a length and no data");
  if (reinterpret_cast<std::uintptr_t>(array.data) % dtype.size != 0)
    refuse(type, field.name, "is misaligned");
  return static_cast<std::size_t>(length);
}

std::shared_ptr<const void> keep(const bf_artifact& artifact) {
  artifact.retain(artifact.owner);
  return {artifact.owner,
          [release = artifact.release](const void* owner) { release(const_cast<void*>(owner)); }};
}

}  // namespace

void OutArrays::add(bf_array array, Kept kept) {
  arrays_.reserve(arrays_.size() + 1);
  array.struct_size = sizeof(bf_array);
  array.data = kept.data;
  array.owner = new std::shared_ptr<const void>(std::move(kept.owner));
  array.release = [](void* owner) { delete static_cast<std::shared_ptr<const void>*>(owner); };
  arrays_.push_back(array);
}

AnyTypeDecl::ArrayRef& AnyTypeDecl::ArrayRef::doc(std::string_view text) {
  decl_.fields_[index_].doc = text;
  return *this;
}
AnyTypeDecl::ArrayRef& AnyTypeDecl::ArrayRef::optional() {
  decl_.fields_[index_].optional = true;
  return *this;
}
AnyTypeDecl::ArrayRef& AnyTypeDecl::ArrayRef::length(std::string_view name) {
  decl_.fields_[index_].length = name;
  return *this;
}

AnyTypeDecl::Field& AnyTypeDecl::add(std::string_view name, std::uint32_t dtype, std::size_t width,
                                     std::size_t offset, std::size_t size) {
  Field& field = fields_.emplace_back();
  field.name = name;
  field.dtype = dtype;
  field.width = width;
  field.offset = offset;
  field.size = size;
  return field;
}

std::string AnyTypeDecl::json() const {
  std::string json = "{";
  write_json_text(json, "id", id_);
  write_json_value(json, "version", std::to_string(version_));
  write_json_text(json, "doc", doc_);
  write_json_name(json, "arrays");
  std::string list;
  for (const Field& field : fields_) {
    list += list.empty() ? "{" : ",{";
    write_json_text(list, "name", field.name);
    write_json_text(list, "dtype", dtype_info(field.dtype).name);
    std::string shape;
    if (!field.scalar) write_json_string(shape, field.length);
    if (field.width != 0) shape += (shape.empty() ? "" : ",") + std::to_string(field.width);
    write_json_value(list, "shape", "[" + shape + "]");
    if (field.optional) write_json_value(list, "optional", "true");
    if (!field.doc.empty()) write_json_text(list, "doc", field.doc);
    list += '}';
  }
  json += "[" + list + "]";
  list.clear();
  for (const auto& [name, doc] : summary_) {
    list += list.empty() ? "{" : ",{";
    write_json_text(list, "name", name);
    write_json_text(list, "doc", doc);
    list += '}';
  }
  write_json_value(json, "summary", "[" + list + "]");
  return json + "}";
}

void AnyTypeDecl::read_into(void* value, const bf_artifact& artifact) const {
  if (artifact.struct_size < BF_ARTIFACT_MIN_SIZE ||
      (artifact.array_count != 0 && artifact.arrays->struct_size < BF_ARRAY_MIN_SIZE)) {
    throw NodeError("an artifact was handed over in structs that are too small",
                    "this is a bug of the engine");
  }
  const std::shared_ptr<const void> owner = keep(artifact);
  std::vector<std::pair<std::string_view, std::uint64_t>> lengths;  // few: a list is quicker than a map
  for (const Field& field : fields_) {
    const bf_array* array = find(artifact, field.name);
    if (array == nullptr) {
      if (field.optional) continue;
      refuse(id_, field.name, "is missing");
    }
    const std::size_t length = checked_length(id_, field, *array);
    char* const member = static_cast<char*>(value) + field.offset;
    if (field.scalar) {
      std::memcpy(member, array->data, field.size);
      continue;
    }
    const auto [name, more] = length_name(field.length);
    if (length < more) refuse(id_, field.name, "is shorter than " + field.length);
    bool known = false;
    for (const auto& [other, count] : lengths) {
      if (other != name) continue;
      known = true;
      if (count != length - more) {
        refuse(id_, field.name,
               "has length " + std::to_string(length) + ", must have " + std::to_string(count + more) + " (" +
                   field.length + ")");
      }
    }
    if (!known) lengths.emplace_back(name, length - more);
    field.read(member, {array->data, length, owner});
  }
}

OutArrays AnyTypeDecl::write_from(const void* value) const {
  OutArrays out;
  for (const Field& field : fields_) {
    const char* const member = static_cast<const char*>(value) + field.offset;
    bf_array array{};
    array.name = bytes(field.name);
    array.dtype = field.dtype;
    Kept kept;
    if (field.scalar) {
      const std::shared_ptr<char[]> copy(new char[field.size]);
      std::memcpy(copy.get(), member, field.size);
      kept = {copy.get(), 1, copy};
    } else {
      kept = field.write(member);
      if (field.optional && kept.count == 0) continue;
      array.shape[array.rank++] = kept.count;
    }
    if (field.width != 0) array.shape[array.rank++] = field.width;
    out.add(array, std::move(kept));
  }
  return out;
}

}  // namespace ballflow::detail
