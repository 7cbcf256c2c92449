// OpenSubdiv's Bfr names a patch's control points and gives their weights at any place of it. The
// weights of one regular patch are those of all.

#include "remesh/subdivision/limit_stencils.h"

#include <opensubdiv/bfr/parameterization.h>

#include "remesh/subdivision/limit_tables.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 1024;
constexpr int shared = 0, own = -1;  // tables of weights

LimitStencils::Weights weights_of(const BfrSurface& surface, int sub_face,
                                  const std::vector<Eigen::Vector2d>& places) {
  const auto parameters = surface.GetParameterization();
  std::vector<double> row(static_cast<size_t>(surface.GetNumControlPoints()));
  LimitStencils::Weights weights(std::ssize(places), std::ssize(row));
  for (size_t i = 0; i < places.size(); ++i) {
    Eigen::Vector2d place = places[i];
    if (parameters.HasSubFaces()) {  // the patch is a part of its face
      parameters.ConvertNormalizedSubFaceToCoord(sub_face, places[i].data(), place.data());
    }
    surface.EvaluateStencil(place.data(), row.data());
    weights.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(row.data(), std::ssize(row));
  }
  return weights;
}

}  // namespace

LimitStencils::LimitStencils(const LimitTopology& topology, std::vector<Eigen::Vector2d> places,
                             int threads)
    : vertex_count_(topology.vertex_count()), places_(std::move(places)) {
  const std::int64_t count = topology.patch_count();
  const auto for_each_patch = [&](const auto& visit) {
    parallel_for(count, grain, threads, [&](std::int64_t first, std::int64_t last) {
      BfrSurface surface;
      for (auto p = static_cast<int>(first); p < static_cast<int>(last); ++p) {
        topology.tables_->factory->InitVertexSurface(topology.face_of(p), &surface);
        visit(p, surface);
      }
    });
  };
  std::vector<int> sizes(static_cast<size_t>(count));
  table_of_.resize(static_cast<size_t>(count));
  for_each_patch([&](int p, const BfrSurface& surface) {
    sizes[static_cast<size_t>(p)] = surface.GetNumControlPoints();
    table_of_[static_cast<size_t>(p)] = surface.IsRegular() ? shared : own;
  });
  lay_out(sizes);
  for_each_patch([&](int p, const BfrSurface& surface) {
    surface.GetControlPointIndices(&controls_[static_cast<size_t>(first_entry(p))]);
    const int table = table_of_[static_cast<size_t>(p)];
    if (table != shared || p == first_polynomial_) {
      tables_[static_cast<size_t>(table)] =
          weights_of(surface, p - topology.first_patch(topology.face_of(p)), places_);
    }
  });
}

void LimitStencils::lay_out(const std::vector<int>& sizes) {
  int tables = 1;
  starts_.push_back(0);
  for (int p = 0; p < static_cast<int>(sizes.size()); ++p) {
    const auto at = static_cast<size_t>(p);
    starts_.push_back(starts_.back() + sizes[at]);
    if (table_of_[at] == own) {
      table_of_[at] = tables++;
    } else if (first_polynomial_ < 0) {
      first_polynomial_ = p;
    }
  }
  tables_.resize(static_cast<size_t>(tables));
  controls_.resize(static_cast<size_t>(starts_.back()));
}

std::vector<Eigen::Vector2d> middles_of_pieces(Scheme scheme, int n) {
  std::vector<Eigen::Vector2d> places;
  const double size = 1.0 / n;
  if (scheme == Scheme::CatmullClark) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) places.emplace_back((i + 0.5) * size, (j + 0.5) * size);
    }
    return places;
  }
  constexpr double third = 1.0 / 3;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      places.emplace_back((i + third) * size, (j + third) * size);
      if (i + j < n - 1) places.emplace_back((i + 2 * third) * size, (j + 2 * third) * size);
    }
  }
  return places;
}

}  // namespace sphparam
