#include "artifacts.hpp"

#include <memory>
#include <utility>

namespace ballflow::python {
namespace {

py::dtype numpy_dtype(std::uint32_t dtype) {
  switch (dtype) {
    case BF_F64:
      return py::dtype::of<double>();
    case BF_F32:
      return py::dtype::of<float>();
    case BF_I64:
      return py::dtype::of<std::int64_t>();
    case BF_I32:
      return py::dtype::of<std::int32_t>();
    case BF_U32:
      return py::dtype::of<std::uint32_t>();
    case BF_U16:
      return py::dtype::of<std::uint16_t>();
    case BF_U8:
      return py::dtype::of<std::uint8_t>();
    default:
      throw Error(ExitCode::plugin, "an array has a dtype that is not known here");
  }
}

std::uint32_t engine_dtype(const py::array& array) {
  const py::dtype dtype = array.dtype();
  switch (dtype.kind()) {
    case 'f':
      if (dtype.itemsize() == 8) return BF_F64;
      if (dtype.itemsize() == 4) return BF_F32;
      break;
    case 'i':
      if (dtype.itemsize() == 8) return BF_I64;
      if (dtype.itemsize() == 4) return BF_I32;
      break;
    case 'u':
      if (dtype.itemsize() == 4) return BF_U32;
      if (dtype.itemsize() == 2) return BF_U16;
      if (dtype.itemsize() == 1) return BF_U8;
      break;
    default:
      break;
  }
  return 0;
}

/// Lets go of Python objects from any thread. Python may have ended by then, which frees everything anyway.
void let_go(py::object* object) {
  if (Py_IsInitialized() == 0) return;
  const py::gil_scoped_acquire gil;
  delete object;
}

std::string_view text_of(bf_bytes text) { return {text.data, static_cast<std::size_t>(text.size)}; }

/// The wide way for an array with no element: the layout wants no null pointer.
constexpr double nothing = 0;

}  // namespace

py::dict arrays_of(const ArtifactPtr& artifact) {
  py::dict arrays;
  for (const NamedArray& array : artifact->arrays()) {
    const py::capsule keeper(new ArtifactPtr(artifact),
                             [](void* kept) { delete static_cast<ArtifactPtr*>(kept); });
    const std::vector<py::ssize_t> shape(array.shape.begin(), array.shape.end());
    const void* const data = array.data != nullptr ? array.data : &nothing;
    py::array shared(numpy_dtype(array.dtype), shape, data, keeper);
    py::detail::array_proxy(shared.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    arrays[py::str(array.name)] = std::move(shared);
  }
  return arrays;
}

ArtifactPtr artifact_of(const TypeDeclaration& type, const py::dict& arrays) {
  const std::shared_ptr<py::object> owner(new py::object(arrays.attr("copy")()), let_go);
  std::vector<NamedArray> named;
  for (const auto& [name, value] : arrays) {
    const auto array = py::cast<py::array>(value);
    const std::uint32_t dtype = engine_dtype(array);
    if (dtype == 0 || (array.flags() & py::array::c_style) == 0)
      throw Error(ExitCode::plugin,
                  "array " + py::cast<std::string>(name) + " is not in the form that is shared");
    named.push_back({py::cast<std::string>(name),
                     dtype,
                     {array.shape(), array.shape() + array.ndim()},
                     array.size() == 0 ? &nothing : array.data()});
  }
  const py::gil_scoped_release release;  // the type's check looks at every element
  return make_artifact(type, named, owner);
}

ArtifactPtr artifact_of(const bf_artifact& raw) {
  raw.retain(raw.owner);
  const std::shared_ptr<const void> owner(
      raw.owner, [release = raw.release](const void* kept) { release(const_cast<void*>(kept)); });
  std::vector<NamedArray> named;
  const auto* at = reinterpret_cast<const char*>(raw.arrays);
  for (std::uint64_t i = 0; i < raw.array_count; ++i) {
    const auto& array = *reinterpret_cast<const bf_array*>(at + i * raw.arrays->struct_size);
    named.push_back(
        {std::string(text_of(array.name)), array.dtype, {array.shape, array.shape + array.rank}, array.data});
  }
  return Artifact::seal(std::string(text_of(raw.type)), static_cast<int>(raw.type_version), std::move(named),
                        text_of(raw.summary), owner);
}

std::vector<bf_array> handed_over(const ArtifactPtr& artifact) {
  std::vector<bf_array> arrays;
  for (const NamedArray& array : artifact->arrays()) {
    bf_array out{};
    out.struct_size = sizeof out;
    out.dtype = array.dtype;
    out.name = {array.name.data(), array.name.size()};
    out.rank = static_cast<std::uint32_t>(array.shape.size());
    for (std::size_t i = 0; i < array.shape.size(); ++i) out.shape[i] = array.shape[i];
    out.data = array.data;
    out.owner = new ArtifactPtr(artifact);
    out.release = [](void* owner) { delete static_cast<ArtifactPtr*>(owner); };
    arrays.push_back(out);
  }
  return arrays;
}

}  // namespace ballflow::python
