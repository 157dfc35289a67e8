#include "inspect/model_report.hpp"

namespace ballflow::inspect {
namespace {

using geometry::Vec3;

constexpr std::size_t listed_places = 10, listed_shells = 1000;

Json point(Vec3 p) { return {p.x, p.y, p.z}; }

Json shell(const geometry::Shell& shell) {
  return {{"triangles", shell.triangles},
          {"vertices", shell.vertices},
          {"genus", shell.genus},
          {"volume", shell.volume},
          {"area", shell.area},
          {"inside", shell.parent < 0 ? Json(nullptr) : Json(shell.parent)},
          {"faces_outwards", shell.faces_outwards},
          {"turned", shell.turned},
          {"bounds", shell.bounds},
          {"box", {point(shell.box.lower), point(shell.box.upper)}}};
}

Json width(const std::optional<geometry::Width>& found) {
  if (!found) return nullptr;
  return {{"width", found->width},
          {"from", point(found->from)},
          {"to", point(found->to)},
          {"triangles", {found->triangle, found->opposite}}};
}

template <class T>
Json first(const std::vector<T>& values, std::size_t most) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(values.size(), most); ++i) list.push_back(values[i]);
  return list;
}

Json mesh(const ModelReport& report) {
  const geometry::Look& look = report.look;
  Json crossings = Json::array();
  for (std::size_t i = 0; i < std::min(look.intersections.pairs.size(), listed_places); ++i) {
    const auto& pair = look.intersections.pairs[i];
    crossings.push_back({{"triangles", pair}, {"place", point(geometry::place_of(report.model.mesh, pair))}});
  }
  Json json = {
      {"closed", look.closed},
      {"manifold", look.topology.manifold},
      {"orientable", look.orientable},
      {"turned_triangles", look.turned},
      {"components", look.topology.components},
      {"open_edges", look.topology.boundary_edges},
      {"nonmanifold_edges", look.topology.nonmanifold_edges},
      {"area", look.area},
      {"dropped",
       {{"degenerate", report.model.degenerate_faces},
        {"repeated", report.model.repeated_faces},
        {"cancelled", report.model.cancelled_faces}}},
      {"flat_triangles",
       {{"count", look.intersections.flat.size()}, {"first", first(look.intersections.flat, listed_places)}}},
      {"self_intersections",
       {{"count", look.intersections.pairs.size()},
        {"all", look.intersections.all},
        {"first", std::move(crossings)}}}};
  Json rims = Json::array();
  for (std::size_t i = 0; i < std::min(look.gaps.rims.size(), listed_places); ++i) {
    const geometry::Rim& rim = look.gaps.rims[i];
    rims.push_back(
        {{"edges", rim.edges}, {"length", rim.length}, {"middle", point(rim.middle)}, {"size", rim.size}});
  }
  json["gaps"] = {{"open_edges", look.gaps.open_edges},
                  {"rims", look.gaps.rims.size()},
                  {"longest", std::move(rims)},
                  {"weld", nullptr}};
  if (const auto& small = look.gaps.small) {
    json["gaps"]["weld"] = {
        {"tolerance", small->tolerance}, {"left", small->left}, {"widest", small->widest}};
    if (report.welded) {
      json["gaps"]["weld"]["closed"] = report.welded->closed;
      json["gaps"]["weld"]["betti"] = report.welded->betti ? Json(*report.welded->betti) : Json(nullptr);
    }
  }
  json["solid"] = {{"betti", look.betti ? Json(*look.betti) : Json(nullptr)},
                   {"unknown_because", look.unknown_because}};
  if (look.shells) {
    json["solid"]["volume"] = look.shells->volume();
    json["solid"]["inside_out"] = look.shells->inside_out;
    json["shells"] = Json::array();
    for (std::size_t i = 0; i < std::min(look.shells->shells.size(), listed_shells); ++i)
      json["shells"].push_back(shell(look.shells->shells[i]));
    json["shell_count"] = look.shells->shells.size();
  }
  if (look.widths) {
    json["widths"] = {{"wall", width(look.widths->wall)},
                      {"slot", width(look.widths->slot)},
                      {"places", look.widths->places},
                      {"thin_walls", look.widths->thin_walls},
                      {"narrow_slots", look.widths->narrow_slots}};
  }
  return json;
}

}  // namespace

Json json_of(const ModelReport& report) {
  const geometry::Look& look = report.look;
  Json findings = Json::array();
  for (const Finding& finding : report.findings)
    findings.push_back({{"what", finding.what}, {"remedy", finding.remedy}});
  Json json = {{"file", report.path},
               {"format", report.format},
               {"bytes", report.bytes},
               {"kind", report.model.mesh.triangles.empty() ? "points" : "mesh"},
               {"points", report.model.points.points.size()},
               {"triangles", report.model.mesh.triangles.size()},
               {"normals", !report.model.points.normals.empty()},
               {"welded_vertices", report.model.welded_vertices},
               {"unused_vertices", report.model.unused_vertices},
               {"box", {point(look.box.lower), point(look.box.upper)}},
               {"unit", {{"guess", report.units}, {"reason", report.units_reason}}},
               {"spacing", {{"median", look.spacing.median}, {"largest", look.spacing.largest}}},
               {"stray_points",
                {{"count", look.strays.points.size()},
                 {"nearest", look.strays.nearest},
                 {"diagonal", look.strays.diagonal},
                 {"first", first(look.strays.points, listed_places)}}},
               {"reading", report.read},
               {"run",
                {{"samples", report.samples < 0 ? Json(nullptr) : Json(report.samples)},
                 {"labels", report.labels},
                 {"reason", report.labels_reason}}},
               {"findings", std::move(findings)},
               {"command", report.command}};
  if (!report.model.mesh.triangles.empty()) json["mesh"] = mesh(report);
  return json;
}

}  // namespace ballflow::inspect
