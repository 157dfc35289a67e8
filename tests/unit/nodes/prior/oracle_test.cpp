// Procrustes analysis and principal components against NumPy and SciPy, which share nothing with ours.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "prior/shape_prior.hpp"
#include "shape_family.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string json(const Array<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ",") + number(value);
  return text + (text.empty() ? "[]" : "]");
}
std::string json(const Array<Vec3>& points) {
  std::string text;
  for (const Vec3& p : points)
    text += (text.empty() ? "[[" : ",[") + number(p.x) + "," + number(p.y) + "," + number(p.z) + "]";
  return text + (text.empty() ? "[]" : "]");
}
template <std::size_t N>
std::string json(const Array<std::array<double, N>>& rows) {
  std::string text;
  for (const auto& row : rows)
    text += (text.empty() ? "[" : ",") + json(Array<double>(std::vector<double>(row.begin(), row.end())));
  return text + "]";
}

// Superposition by turns from another start and in another order of steps, principal components by the
// singular values of the whole matrix; SciPy lays the first two instances on each other.
constexpr const char* script = R"(
import json, sys
import numpy as np
from scipy.spatial import procrustes
d = json.load(open(sys.argv[1]))
scale, share = d["scale"], d["share"]
C = [np.array(i["centers"]) for i in d["instances"]]
L = [np.log(np.array(i["radii"])) for i in d["instances"]]
P = [np.array(i["points"]).reshape(-1, 3) for i in d["instances"]]
n, k, m = len(C), len(C[0]), len(P[0])
w = np.concatenate([np.full(k, (1 - share) / k), np.full(m, share / max(m, 1))])
X = [np.vstack([c, p]) for c, p in zip(C, P)]
X = [x - w @ x / w.sum() for x in X]
size = [np.sum(w[:, None] * x * x) for x in X]
Y = [x.copy() for x in X]
s = np.ones(n)
for _ in range(300):
    mean = sum(Y) / n
    for i in range(n):
        u, v, wt = np.linalg.svd((w[:, None] * mean).T @ X[i])
        D = np.diag([1, 1, np.sign(np.linalg.det(u @ wt))])
        s[i] = (v @ np.diag(D)) / size[i] if scale else 1
        Y[i] = s[i] * X[i] @ (u @ D @ wt).T
    if scale:
        f = np.sqrt(sum(size) / np.sum(s * s * size)); s = s * f; Y = [f * y for y in Y]
V = np.array([np.concatenate([y[:k].ravel(), l + np.log(si), y[k:].ravel()]) for y, l, si in zip(Y, L, s)])
unit = d["unit"]
metric = np.concatenate([np.full(3 * k, (1 - share) / k), np.full(k, (1 - share) / k * unit * unit), np.full(3 * m, share / max(m, 1))])
A = (V - V.mean(0)) * np.sqrt(metric)
u, sv, vt = np.linalg.svd(A, full_matrices=False)
variances = sv ** 2 / (n - 1)
q = len(d["variances"])
def close(a, b, what, tolerance=1e-9):
    worst = np.max(np.abs(np.asarray(a) - np.asarray(b))) if np.size(a) else 0
    print(what, worst)
    if not worst <= tolerance: sys.exit(what + " differs by " + str(worst))
close(np.array(d["variances"]) / variances[0], variances[:q] / variances[0], "variances")
# Modes of clearly different variance alone are determined.
for j in range(q):
    if variances[j] < 1e-4 * variances[0]: continue
    mine = np.array(d["scores"]).reshape(n, q)[:, j] / np.sqrt(n - 1)
    close(mine * np.sign(mine @ u[:, j]), u[:, j], "scores of mode %d" % j)
pairs = lambda x: np.linalg.norm(x[:, None] - x[None], axis=-1)
mean = V.mean(0)
close(pairs(np.array(d["centers"])), pairs(mean[:3 * k].reshape(-1, 3)), "mean")
close(np.log(d["radii"]), mean[3 * k:4 * k], "radii")
if scale and share == 0 and n == 2:
    a, b, disparity = procrustes(C[0], C[1])
    T = [np.array(t).reshape(3, 4) for t in d["poses"]]
    Z = [c @ t[:, :3].T + t[:, 3] for c, t in zip(C, T)]
    Z = [z - z.mean(0) for z in Z]
    correlation = np.sum(Z[0] * Z[1]) / np.linalg.norm(Z[0]) / np.linalg.norm(Z[1])
    close(1 - correlation ** 2, disparity, "disparity")
)";

TEST(oracle, procrustes_analysis_and_modes_are_those_of_numpy_and_scipy) {
  if (std::system("python3 -c 'import numpy, scipy' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3 with numpy and scipy is not installed";
  const test::TempFolder folder;
  test::write_file(folder.file("compare.py"), script);
  struct Case {
    std::size_t instances;
    bool scale;
    double share;
  };
  for (const Case& one : {Case{9, false, 0.5}, Case{9, true, 0.25}, Case{5, false, 0}, Case{2, true, 0}}) {
    Family known = family(one.instances);
    Random random(6);
    // Something that no two modes explain.
    for (MatchedBalls& member : known.members) {
      std::vector<Vec3> centers(member.centers.begin(), member.centers.end());
      for (Vec3& c : centers) c = c + 0.05 * Vec3{random.unit(), random.unit(), random.unit()};
      member.centers = std::move(centers);
    }
    ShapePriorOptions options;
    options.scale = one.scale;
    options.point_share = one.share;
    options.along = 1;
    options.draws = 0;
    const ShapePrior prior = shape_prior(known.members, {}, options);
    std::string text = "{\"scale\":" + std::string(one.scale ? "true" : "false") +
                       ",\"share\":" + number(one.share) + ",\"unit\":" + number(prior.radius_unit) +
                       ",\"variances\":" + json(prior.variances) + ",\"scores\":" + json(prior.scores) +
                       ",\"centers\":" + json(prior.centers) + ",\"radii\":" + json(prior.radii) +
                       ",\"poses\":" + json(prior.poses) + ",\"instances\":[";
    for (std::size_t i = 0; i < known.members.size(); ++i) {
      const MatchedBalls& member = known.members[i];
      text += std::string(i == 0 ? "" : ",") + "{\"centers\":" + json(member.centers) +
              ",\"radii\":" + json(member.radii) + ",\"points\":" + json(member.points) + "}";
    }
    test::write_file(folder.file("case.json"), text + "]}");
    const std::string command =
        "python3 '" + folder.file("compare.py") + "' '" + folder.file("case.json") + "' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << one.instances << one.scale << one.share;
  }
}

}  // namespace
}  // namespace ballflow::geometry
