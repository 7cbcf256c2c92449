#include "bake/texels/coverage.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

// Values come as they are, without room between; the channel is put in from the last one backwards.

namespace sphparam {
namespace {

class Coverage {
 public:
  Coverage(const SurfaceField& field, const FillerMarks& fillers)
      : from_(static_cast<size_t>(field.channels)), fillers_(fillers) {}

  /// faces: calls back with the face of each value, in their order.
  template <class ForEachFace>
  void add(size_t count, const ForEachFace& for_each_face, float* values) const {
    std::vector<float> covered;
    covered.reserve(count);
    for_each_face(
        [&](Face f) { covered.push_back(fillers_[static_cast<size_t>(f)] ? 0.0F : 1.0F); });
    if (from_ == 4) {
      for (size_t i = 0; i < count; ++i) values[4 * i + 3] *= covered[i];
      return;
    }
    for (size_t i = count; i-- > 0;) {
      std::copy_backward(values + i * from_, values + (i + 1) * from_,
                         values + i * (from_ + 1) + from_);
      values[i * (from_ + 1) + from_] = covered[i];
    }
  }

 private:
  size_t from_;
  FillerMarks fillers_;
};

}  // namespace

SurfaceField with_coverage(SurfaceField field, const FillerMarks& fillers) {
  const auto coverage = std::make_shared<const Coverage>(field, fillers);
  if (field.evaluate) {
    field.evaluate = [coverage, plain = std::move(field.evaluate)](
                         std::span<const SurfaceSample> samples, float* values) {
      plain(samples, values);
      coverage->add(
          samples.size(),
          [&](const auto& visit) {
            for (const SurfaceSample& sample : samples) visit(sample.point.face);
          },
          values);
    };
  }
  if (field.evaluate_runs) {
    field.evaluate_runs = [coverage, plain = std::move(field.evaluate_runs)](
                              std::span<const SurfaceRun> runs, float* values) {
      plain(runs, values);
      size_t count = 0;
      for (const SurfaceRun& run : runs) count += static_cast<size_t>(run.count);
      coverage->add(
          count,
          [&](const auto& visit) {
            for (const SurfaceRun& run : runs) {
              for (int i = 0; i < run.count; ++i) visit(run.face);
            }
          },
          values);
    };
  }
  field.about +=
      (field.about.empty() ? "" : "; ") + std::string("alpha is 0 where nothing is surface");
  field.has_coverage = field.channels < 4;
  field.channels = std::min(field.channels + 1, 4);
  return field;
}

}  // namespace sphparam
