#include "ballflow/sdk/library.hpp"

#include <memory>

namespace ballflow::detail {

namespace {

struct NodeEntry {
  const AnyNodeDecl* decl;
  std::string json;
  bf_node entry;
};

struct TypeEntry {
  const AnyTypeDecl* decl;
  std::string (*broken)(const AnyTypeDecl&, const bf_artifact&);
  std::string (*summary)(const AnyTypeDecl&, const bf_artifact&);
  std::string json;
  bf_type entry;
};

struct PluginEntry {
  std::string name, version;
  std::vector<const bf_node*> nodes;
  std::vector<const bf_type*> types;
  bf_plugin table;
};

void check_type(void* self, const bf_artifact* artifact, void* context,
                void (*found)(void*, bf_bytes)) noexcept {
  const auto& type = *static_cast<const TypeEntry*>(self);
  try {
    const std::string broken = type.broken(*type.decl, *artifact);
    if (!broken.empty()) found(context, bytes(broken));
  } catch (const std::exception& error) {
    found(context, bytes(error.what()));
  } catch (...) {
    found(context, bytes("its check threw something that is not an exception"));
  }
}

void summarize_type(void* self, const bf_artifact* artifact, void* context,
                    void (*made)(void*, bf_bytes)) noexcept {
  const auto& type = *static_cast<const TypeEntry*>(self);
  try {
    made(context, bytes(type.summary(*type.decl, *artifact)));
  } catch (...) {
    // Of an artifact that is valid there is a summary, unless memory ran out: then there is none.
  }
}

void list_files(void* self, bf_bytes params, void* context,
                void (*found)(void*, bf_bytes, bf_bytes)) noexcept {
  for (const NamedFile& file : static_cast<const NodeEntry*>(self)->decl->files(params))
    found(context, bytes(file.name), bytes(file.path));
}

}  // namespace

const bf_node* keep_node(const AnyNodeDecl& decl) {
  auto kept = std::make_unique<NodeEntry>();
  kept->decl = &decl;
  kept->json = decl.json();
  kept->entry = {sizeof(bf_node),
                 0,
                 bytes(kept->json),
                 kept.get(),
                 [](void* self, const bf_run* run) noexcept -> int {
                   return static_cast<const NodeEntry*>(self)->decl->run(*run);
                 },
                 decl.names_files() ? &list_files : nullptr};
  return &kept.release()->entry;
}

const bf_type* keep_type(const AnyTypeDecl& decl,
                         std::string (*broken)(const AnyTypeDecl&, const bf_artifact&),
                         std::string (*summary)(const AnyTypeDecl&, const bf_artifact&)) {
  auto kept = std::make_unique<TypeEntry>();
  kept->decl = &decl;
  kept->broken = broken;
  kept->summary = summary;
  kept->json = decl.json();
  kept->entry = {sizeof(bf_type), 0, bytes(kept->json), kept.get(), &check_type, &summarize_type};
  return &kept.release()->entry;
}

const bf_plugin* keep_plugin(std::string_view name, std::string_view version,
                             std::vector<const bf_node*> (*nodes)(),
                             std::vector<const bf_type*> (*types)()) noexcept {
  try {
    auto kept = std::make_unique<PluginEntry>();
    kept->name = name;
    kept->version = version;
    kept->nodes = nodes();
    kept->types = types();
    kept->table = {sizeof(bf_plugin),
                   BALLFLOW_ABI_VERSION,
                   bytes(kept->name),
                   bytes(kept->version),
                   kept->types.data(),
                   kept->types.size(),
                   kept->nodes.data(),
                   kept->nodes.size(),
                   nullptr,
                   nullptr};
    return &kept.release()->table;
  } catch (...) {
    return nullptr;  // the engine reports that the tables could not be made
  }
}

}  // namespace ballflow::detail
