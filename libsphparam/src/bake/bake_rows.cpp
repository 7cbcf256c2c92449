// Rows in bands, bands in parallel, a few at a time; then the sink gets them in order. Within a
// band: the points of all texels, then field by field the values of some thousand texels at once,
// so that what a field costs is not lost in calls.

#include "bake/bake_rows.h"

#include <algorithm>

#include "bake/bake_progress.h"
#include "bake/image_level.h"
#include "bake/sample_seed.h"
#include "bake/texels/calm_walls.h"
#include "bake/texels/crowded_texels.h"
#include "sphparam/parallel.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

constexpr int bands_a_thread = 4;                // before the sink gets them …
constexpr std::int64_t group_bytes = 256 << 20;  // … but for images so wide that they fill this
constexpr int texels_a_batch = 4096;             // some more where runs are long
constexpr size_t samples_a_look = 64;            // at the progress: rays may take ms a sample

struct Work {
  const BakeScene& scene;
  std::span<const SurfaceField> fields;
  const BakeOptions& options;
  const TexelFinder& finder;
  BakeProgress& progress;
};

using BandValues = std::vector<std::vector<float>>;  // a field, a band

/// Consecutive runs, and the samples they stand for where a field asks for those.
class Batch {
 public:
  Batch(std::span<const SurfaceRun> runs, std::span<const TexelRun> places, std::int64_t texel,
        int sample, const Work& work)
      : runs_(runs),
        places_(places),
        texel_(texel),
        sample_(sample),
        progress_(work.progress),
        walls_(work.scene.walls.get()) {}

  /// The values of a field, colours linear.
  void evaluate(const SurfaceField& field, float* values) {
    find(field, values);
    if (field.amend) field.amend(hidden(), places_, values);
  }

 private:
  void find(const SurfaceField& field, float* values) {
    progress_.look();
    if (field.evaluate_runs) return field.evaluate_runs(runs_, values);
    expand();
    const auto channels = static_cast<size_t>(field.channels);
    for (size_t i = 0; i < samples_.size(); i += samples_a_look) {
      const size_t count = std::min(samples_a_look, samples_.size() - i);
      field.evaluate(std::span(samples_).subspan(i, count), values + channels * i);
      progress_.look();
    }
    if (field.kind != FieldKind::Colour) return;
    const SrgbCurves& curves = SrgbCurves::get();
    const int colours = std::min(field.proper_channels(), 3);
    for (size_t i = 0; i < samples_.size(); ++i, values += field.channels) {
      for (int c = 0; c < colours; ++c) values[c] = curves.to_linear(values[c]);
    }
  }

  /// Worked out once for all fields: it asks for the nearest points.
  std::span<const float> hidden() {
    if (hidden_.empty()) hidden_ = walls_->shares(runs_, places_);
    return hidden_;
  }

  void expand() {
    if (!samples_.empty()) return;
    for (const SurfaceRun& run : runs_) {
      for (int i = 0; i < run.count; ++i) {
        samples_.push_back({{run.face, run.first + i * run.step},
                            sample_seed(texel_ + std::ssize(samples_), sample_),
                            {},
                            run.step,
                            run.below,
                            run.found,
                            0});
      }
    }
    size_t next = 0;
    for (const TexelRun& run : places_) {
      for (int i = 0; i < run.count; ++i) samples_[next++].place = run.at(i);
    }
    if (!walls_) return;
    for (size_t i = 0; i < samples_.size(); ++i) samples_[i].wall = hidden()[i];
  }

  std::span<const SurfaceRun> runs_;
  std::span<const TexelRun> places_;
  std::int64_t texel_;  // of the first
  int sample_;
  BakeProgress& progress_;
  const CalmWalls* walls_;  // may be none
  std::vector<SurfaceSample> samples_;
  std::vector<float> hidden_;
};

/// Calls visit(batch, its first texel in the band, its size) for all texels of a band.
template <class Visit>
void for_each_batch(const Work& work, int band, const TexelPoints& points, int sample,
                    Visit&& visit) {
  const std::int64_t start =
      static_cast<std::int64_t>(work.finder.owners().first_row(band)) * work.options.width;
  const std::span<const SurfaceRun> runs = points.runs;
  const std::span<const TexelRun> places = points.places;
  std::int64_t texel = 0;
  for (size_t run = 0, place = 0; run < runs.size();) {
    // A batch ends where both lists have come equally far.
    const size_t first_run = run, first_place = place;
    std::int64_t in_runs = 0, in_places = 0;
    while (run < runs.size() && (in_runs < texels_a_batch || in_runs != in_places)) {
      if (in_runs <= in_places) in_runs += runs[run++].count;
      while (in_places < in_runs) in_places += places[place++].count;
    }
    Batch batch(runs.subspan(first_run, run - first_run),
                places.subspan(first_place, place - first_place), start + texel, sample, work);
    visit(batch, static_cast<size_t>(texel), static_cast<size_t>(in_places));
    texel += in_places;
  }
}

/// Adds weight · value of every texel at one point of it; for a single sample writes it.
void add_samples(const Work& work, int band, const TexelPoints& points, int sample, float weight,
                 bool labels, BandValues& values) {
  std::vector<float> buffer;
  for_each_batch(work, band, points, sample, [&](Batch& batch, size_t texel, size_t count) {
    for (size_t f = 0; f < work.fields.size(); ++f) {
      const SurfaceField& field = work.fields[f];
      if (has_means(field.kind) == labels) continue;
      const auto channels = static_cast<size_t>(field.channels);
      float* out = &values[f][texel * channels];
      if (weight == 1) {
        batch.evaluate(field, out);
        continue;
      }
      buffer.resize(count * channels);
      batch.evaluate(field, buffer.data());
      for (size_t i = 0; i < count * channels; ++i) out[i] += weight * buffer[i];
    }
    work.progress.add(static_cast<std::int64_t>(count));
  });
}

/// Replaces these texels by their means. `seed`: of their first point.
void average(const Work& work, const CrowdedTexels& crowded, std::int64_t seed,
             std::vector<float>& buffer, BandValues& values) {
  Batch batch(crowded.points.runs, crowded.points.places, seed, 0, work);
  for (size_t f = 0; f < work.fields.size(); ++f) {
    const SurfaceField& field = work.fields[f];
    if (!has_means(field.kind)) continue;
    const auto channels = static_cast<size_t>(field.channels);
    buffer.resize(crowded.points.runs.size() * channels);
    batch.evaluate(field, buffer.data());
    for (const CrowdedTexels::Texel& texel : crowded.texels) {
      float* out = &values[f][texel.index * channels];
      std::fill_n(out, channels, 0.0F);
      for (size_t i = texel.first; i < texel.last; ++i) {
        for (size_t c = 0; c < channels; ++c) {
          out[c] += crowded.weights[i] * buffer[i * channels + c];
        }
      }
    }
  }
}

bool is_label(const SurfaceField& field) { return !has_means(field.kind); }

/// Replaces the texels of a band that hold many triangles by their means.
void average_crowded(const Work& work, int band, const TexelPoints& centres, BandValues& values) {
  const std::int64_t start =
      static_cast<std::int64_t>(work.finder.owners().first_row(band)) * work.options.width;
  std::vector<float> buffer;
  const bool calm = std::ranges::all_of(
      work.fields, [](const SurfaceField& field) { return field.calm || is_label(field); });
  for_crowded_texels(
      work.scene, work.finder, band, centres, calm, [&](const CrowdedTexels& crowded) {
        average(work, crowded, start * crowded_seeds + crowded.before, buffer, values);
      });
}

/// How often the texels are gone through.
int passes(std::span<const SurfaceField> fields, const BakeOptions& options) {
  const int with_labels = std::ranges::any_of(fields, is_label) ? 1 : 0;
  const bool only_labels = std::ranges::all_of(fields, is_label);
  return with_labels + (only_labels ? 0 : options.samples * options.samples);
}

BandValues bake_band(const Work& work, int band) {
  work.progress.look();
  const auto texels = static_cast<size_t>(work.finder.owners().rows(band)) *
                      static_cast<size_t>(work.options.width);
  BandValues values;
  for (const SurfaceField& field : work.fields) {
    values.emplace_back(texels * static_cast<size_t>(field.channels), 0.0F);
  }
  const int n = work.options.samples;
  const TexelPoints centres = work.finder.points(band, 0.5, 0.5);
  if (!std::ranges::all_of(work.fields, is_label)) {
    for (int s = 0; s < n * n; ++s) {
      const double x = (s % n + 0.5) / n, y = (s / n + 0.5) / n;
      add_samples(work, band, n == 1 ? centres : work.finder.points(band, x, y), s,
                  1.0F / static_cast<float>(n * n), false, values);
    }
    average_crowded(work, band, centres, values);
  }
  if (std::ranges::any_of(work.fields, is_label)) {
    add_samples(work, band, centres, 0, 1, true, values);
  }
  for (size_t f = 0; f < work.fields.size(); ++f) {
    if (work.fields[f].kind == FieldKind::Direction) make_unit(values[f], work.fields[f].channels);
  }
  return values;
}

int bands_at_once(std::span<const SurfaceField> fields, int width, int threads) {
  std::int64_t channels = 0;
  for (const SurfaceField& field : fields) channels += field.channels;
  const std::int64_t band = channels * TexelOwners::rows_a_band * width * 4;
  const auto fit = static_cast<int>(std::min<std::int64_t>(
      group_bytes / std::max<std::int64_t>(band, 1), bands_a_thread * threads));
  return std::max(threads, fit);
}

}  // namespace

void bake(const BakeScene& scene, std::span<const SurfaceField> fields, const BakeOptions& options,
          const RowSink& sink) {
  const TexelOwners owners(scene.target.chart, options.width, options.height);
  report(options.progress, "bake", 0);
  const TexelFinder finder(scene, owners, options.interpolation, options.threads);
  BakeProgress progress(options.progress,
                        std::int64_t{options.width} * options.height * passes(fields, options));
  const Work work{scene, fields, options, finder, progress};
  const int threads = resolve_threads(options.threads);
  const int group = bands_at_once(fields, options.width, threads);
  for (int first = 0; first < owners.band_count(); first += group) {
    const int count = std::min(group, owners.band_count() - first);
    std::vector<BandValues> done(static_cast<size_t>(count));
    parallel_for(count, 1, threads, [&](std::int64_t from, std::int64_t to) {
      for (std::int64_t b = from; b < to; ++b) {
        done[static_cast<size_t>(b)] = bake_band(work, first + static_cast<int>(b));
      }
    });
    parallel_for(std::ssize(fields), 1, threads, [&](std::int64_t from, std::int64_t to) {
      for (auto f = static_cast<size_t>(from); f < static_cast<size_t>(to); ++f) {
        for (int b = 0; b < count; ++b) {
          sink(f, owners.first_row(first + b), owners.rows(first + b),
               done[static_cast<size_t>(b)][f].data());
        }
      }
    });
  }
  report(options.progress, "bake", 1);
}

}  // namespace sphparam
