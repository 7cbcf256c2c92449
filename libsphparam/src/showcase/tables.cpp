#include "showcase/tables.h"

#include <algorithm>
#include <functional>
#include <string>

#include "report/svg.h"
#include "sphparam/words.h"

namespace sphparam {
namespace {

constexpr const char* nothing = "–";

using Cell = std::function<std::string(const PageEntry&)>;

PageTable table_of(std::string caption, const std::vector<PageEntry>& entries,
                   const std::vector<std::pair<std::string, Cell>>& rows) {
  PageTable table{std::move(caption), {""}, {}};
  for (const PageEntry& page_entry : entries) table.header.push_back(page_entry.entry.name);
  for (const auto& [name, cell] : rows) {
    std::vector<std::string> row{name};
    for (const PageEntry& page_entry : entries) row.push_back(cell(page_entry));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Cell figure(double DistortionSummary::*member) {
  return [member](const PageEntry& page_entry) {
    const auto& figures = page_entry.entry.figures;
    return figures ? significant(*figures.*member) : nothing;
  };
}

Cell count_of_chart(const std::function<long(const SphericalChart&)>& count) {
  return [count](const PageEntry& page_entry) {
    return page_entry.chart() ? grouped(count(*page_entry.chart())) : nothing;
  };
}

std::string mean_of_angles(const PageEntry& page_entry) {
  const auto& figures = page_entry.entry.figures;
  return figures ? significant(figures->mean_abs_ln_angle) + flat_images_words(*figures) : nothing;
}

std::string percent_within_two(const PageEntry& page_entry) {
  const auto& figures = page_entry.entry.figures;
  return figures ? decimal(100 * figures->area_within_two, 1) + " %" : nothing;
}

std::string degree(const PageEntry& page_entry) {
  const Entry& c = page_entry.entry;
  const bool counted = c.has_map() && c.certificate.fold_count() == 0;
  return counted ? std::to_string(c.certificate.degree) : nothing;
}

}  // namespace

PageTable distortion_table(const std::vector<PageEntry>& entries) {
  using D = DistortionSummary;
  PageTable table = table_of(
      "Ratios are result / input after both total areas were made equal; the last column is what a "
      "map without distortion would have. Means over all triangles and angles are the paper's; "
      "weighted ones count every triangle by its area.",
      entries,
      {{"mean |ln area|", figure(&D::mean_abs_ln_area)},
       {"mean |ln angle|", mean_of_angles},
       {"areas within [½, 2]", percent_within_two},
       {"smallest area ratio", figure(&D::area_ratio_min)},
       {"area ratio, 1 % below", figure(&D::area_ratio_p01)},
       {"area ratio, median", figure(&D::area_ratio_p50)},
       {"area ratio, 1 % above", figure(&D::area_ratio_p99)},
       {"largest area ratio", figure(&D::area_ratio_max)},
       {"largest factor of an angle", figure(&D::angle_ratio_max)},
       {"weighted |log2 area|", figure(&D::weighted_abs_log2_area)},
       {"symmetric Dirichlet", figure(&D::symmetric_dirichlet)},
       {"quasi-conformal, mean", figure(&D::quasi_conformal_mean)},
       {"quasi-conformal, largest", figure(&D::quasi_conformal_max)},
       {"stretch L²", figure(&D::stretch_l2)},
       {"stretch L∞", figure(&D::stretch_linf)}});
  const std::vector<std::string> ideals = {"0", "0", "100 %", "1", "1", "1", "1", "1",
                                           "1", "0", "4",     "1", "1", "1", "1"};
  table.header.push_back("perfect");
  for (size_t i = 0; i < ideals.size(); ++i) table.rows[i].push_back(ideals[i]);
  return table;
}

PageTable certificate_table(const std::vector<PageEntry>& entries) {
  std::vector<std::pair<std::string, Cell>> rows = {
      {"verdict", [](const PageEntry& e) { return short_verdict(e.entry); }},
      {"folded triangles",
       [](const PageEntry& e) { return grouped(e.entry.certificate.fold_count()); }},
      {"degree", degree}};
  if (std::any_of(entries.begin(), entries.end(),
                  [](const PageEntry& e) { return e.filler_share.has_value(); })) {
    rows.emplace_back("of the sphere, what closes holes", [](const PageEntry& e) {
      return e.filler_share ? decimal(100 * *e.filler_share, 2) + " %" : nothing;
    });
  }
  return table_of(
      "A map is one-to-one when the determinant of every triangle is positive, decided exactly, "
      "and the sphere is covered once.",
      entries, rows);
}

PageTable chart_table(const std::vector<PageEntry>& entries) {
  const bool any = std::any_of(entries.begin(), entries.end(), [](const PageEntry& page_entry) {
    return page_entry.chart() != nullptr;
  });
  if (!any) return {};
  return table_of(
      "The (u, v) chart that textures need: the mesh is split at the poles, along the meridian "
      "θ = 0 and where it would fold in (u, v); no split moves the surface.",
      entries,
      {{"certified",
        [](const PageEntry& e) {
          return !e.chart() ? nothing : e.chart()->certificate.one_to_one() ? "yes" : "no";
        }},
       {"triangles", count_of_chart([](const SphericalChart& c) { return c.triangles.rows(); })},
       {"vertices in a buffer",
        count_of_chart([](const SphericalChart& c) { return c.wedge_count(); })},
       {"splits at ±z",
        count_of_chart([](const SphericalChart& c) { return c.counts.pole_splits; })},
       {"splits along θ = 0",
        count_of_chart([](const SphericalChart& c) { return c.counts.meridian_splits; })},
       {"splits of folds",
        count_of_chart([](const SphericalChart& c) { return c.counts.fold_splits; })}});
}

PageTable provenance_table(const std::vector<PageEntry>& entries) {
  std::vector<std::pair<std::string, Cell>> rows;
  const auto value = [](const PageEntry& page_entry, const std::string& key) -> std::string {
    for (const auto& [known, text] : page_entry.provenance) {
      if (known == key) return text;
    }
    return nothing;
  };
  for (const PageEntry& page_entry : entries) {
    for (const auto& [key, text] : page_entry.provenance) {
      const auto same = [&key = key](const auto& row) { return row.first == key; };
      if (std::any_of(rows.begin(), rows.end(), same)) continue;
      rows.emplace_back(key, [key = key, value](const PageEntry& e) { return value(e, key); });
    }
  }
  if (rows.empty()) return {};
  return table_of("What the files say of how their maps came about.", entries, rows);
}

}  // namespace sphparam
