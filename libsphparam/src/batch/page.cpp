// A page of C++ around a table of JSON: what is counted and drawn once is made here, what is sorted
// and leafed through by batch_page.js.

#include "report/page.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "batch/distribution.h"
#include "batch/each_item.h"
#include "batch/pictures.h"
#include "batch/record.h"
#include "embedded/batch_page.css.h"
#include "embedded/batch_page.js.h"
#include "io/uri.h"
#include "number_text.h"
#include "report/svg.h"
#include "sphparam/batch/results.h"
#include "sphparam/batch/status.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t named_outliers = 8;

/// What the page shows of an item; figures of its first step that has them.
struct Shape {
  std::string outcome = "open", reason, repairs;
  std::vector<std::string> warnings;
  std::string page;               // of its own; empty: none
  std::string picture;            // below the folder of the batch; empty: none
  std::string unwritten_picture;  // why it could not be kept there
  int code = 0, attempt = 0;
  std::optional<double> area, angle, within_two, vertices, seconds;
};

std::optional<double> number_at(const Json& json, const char* part, const char* key) {
  const auto found = json.find(part);
  if (found == json.end() || !found->is_object()) return std::nullopt;
  const auto value = found->find(key);
  return value != found->end() && value->is_number() ? std::optional(value->get<double>())
                                                     : std::nullopt;
}

void take_figures(const Json& report, Shape& shape) {
  if (!report.is_object()) return;
  const auto take = [&](std::optional<double>& figure, const char* part, const char* key) {
    if (!figure) figure = number_at(report, part, key);
  };
  take(shape.area, "distortion", "mean_abs_ln_area");
  take(shape.angle, "distortion", "mean_abs_ln_angle");
  take(shape.within_two, "distortion", "area_within_two");
  take(shape.vertices, "inspection", "vertices");
  if (report.value("command", "") == "asset" && !shape.vertices && report.contains("vertices"))
    shape.vertices = report["vertices"].get<double>();
}

Shape shape_of(const std::string& folder, const BatchPlan& plan, const BatchItem& item) {
  Shape shape;
  const auto stored = record_about(folder, item);
  if (!stored) return shape;
  const Json record = Json::parse(stored->bytes, nullptr, false);
  if (record.is_discarded()) throw ReadError(stored->path, "this is no whole record of a batch");
  shape.outcome = record.value("outcome", "open");
  shape.reason =
      words_of_step(stored->head.step, plan) + without_folders(stored->head.reason, item);
  shape.repairs = stored->head.repairs;
  for (const std::string& warning : stored->head.warnings)
    shape.warnings.push_back(without_folders(warning, item));
  shape.code = stored->head.code;
  shape.attempt = stored->head.attempt;
  shape.seconds = stored->head.cpu_seconds;
  for (const BatchFile& file : stored->head.files) {
    if (shape.page.empty() && file.name.ends_with(".html")) shape.page = file.name;
  }
  try {
    shape.picture = picture_of(folder, item.id, stored->head.files);
  } catch (const WriteError& error) {  // who may only read the folder gets a page all the same
    shape.unwritten_picture = error.what();
  }
  for (const Json& step : record.value("steps", Json::array())) take_figures(step["report"], shape);
  return shape;
}

std::vector<Shape> shapes_of(const std::string& folder, const BatchPlan& plan, int threads) {
  constexpr std::int64_t grain = 16;
  return of_each_item(plan, grain, threads,
                      [&](const BatchItem& item) { return shape_of(folder, plan, item); });
}

/// Three digits: more is not looked at, and the page is loaded as a whole.
Json short_json(const std::optional<double>& value) {
  if (!value) return nullptr;
  return Json::parse(short_number(*value, 4), nullptr, false);
}

/// Whole, whatever its digits.
Json count_json(const std::optional<double>& value) {
  if (!value) return nullptr;
  return static_cast<std::int64_t>(*value);
}

/// The row of a shape, in the order that batch_page.js knows.
Json row_json(const BatchItem& item, const Shape& shape, double outlyingness) {
  return {item.id,
          shape.outcome,
          count_json(shape.vertices),
          short_json(shape.area),
          short_json(shape.angle),
          short_json(shape.within_two),
          short_json(shape.seconds),
          short_json(outlyingness),
          shape.picture,
          shape.page,
          shape.code,
          shape.reason,
          shape.attempt,
          shape.repairs,
          shape.warnings};
}

/// A figure of all shapes, with its plot and who is far out.
class Figure {
 public:
  Figure(std::string title, const std::vector<Shape>& shapes, std::optional<double> Shape::*figure)
      : title_(std::move(title)) {
    for (const Shape& shape : shapes) values_.push_back(shape.*figure);
    distribution_ = distribution_of(values_);
  }

  double outlyingness(std::size_t i) const {
    return values_[i] ? sphparam::outlyingness(distribution_, *values_[i]) : 0;
  }

  void add_to(Page& page, const std::vector<std::string>& names) const {
    page.insert("<figure class=\"distribution\">" +
                distribution_plot(distribution_, title_, names) + outlier_list(names) +
                "</figure>\n");
  }

 private:
  std::string outlier_list(const std::vector<std::string>& names) const {
    std::vector<std::pair<double, std::size_t>> outliers;
    for (std::size_t i = 0; i < distribution_.values.size(); ++i)
      if (distribution_.values[i] > distribution_.outlier_from)
        outliers.emplace_back(distribution_.values[i], distribution_.items[i]);
    std::ranges::sort(outliers, std::ranges::greater{});
    if (outliers.empty()) return "";
    std::string html = "<figcaption>Outliers: ";
    for (std::size_t i = 0; i < std::min(outliers.size(), named_outliers); ++i) {
      const std::string id = escaped(names[outliers[i].second]);
      html += (i ? ", " : "") + std::string("<a href=\"#") + id + "\">" + id + "</a> (" +
              significant(outliers[i].first) + ")";
    }
    return html + (outliers.size() > named_outliers ? ", …" : "") + "</figcaption>";
  }

  std::string title_;
  std::vector<std::optional<double>> values_;
  Distribution distribution_;
};

void add_counts(Page& page, const BatchStatus& status, const std::vector<Shape>& shapes) {
  const auto certified = std::ranges::count(shapes, std::string("certified"), &Shape::outcome);
  double cpu = 0;
  for (const Shape& shape : shapes) cpu += shape.seconds.value_or(0);
  page.verdict(certified == std::ssize(shapes) ? "all shapes are certified one-to-one"
                                               : std::to_string(status.failed) + " failed, " +
                                                     std::to_string(status.open()) + " not run",
               status.done == status.items);
  page.key_figures({{"shapes", grouped(static_cast<long>(status.items))},
                    {"certified", grouped(certified)},
                    {"done, without a map", grouped(static_cast<long>(status.done) - certified)},
                    {"repaired", grouped(static_cast<long>(status.repaired))},
                    {"wrapped", grouped(static_cast<long>(status.wrapped))},
                    {"with warnings", grouped(static_cast<long>(status.warned))},
                    {"failed", grouped(static_cast<long>(status.failed))},
                    {"CPU time", duration(cpu)}});
}

void add_failures(Page& page, const BatchStatus& status) {
  if (status.failures.empty()) return;
  page.heading("Failures");
  std::string html =
      "<div class=\"wide\" tabindex=\"0\"><table class=\"failures\"><thead><tr>"
      "<th>count</th><th>code</th><th>reason, of the first</th><th>shapes</th>"
      "</tr></thead>\n<tbody>\n";
  for (const BatchFailures& group : status.failures) {
    html += "<tr><td>" + std::to_string(group.count) + "</td><td>" + std::to_string(group.code) +
            "</td><td>" + escaped(group.reason) + "</td><td>";
    for (const std::string& id : group.ids)
      html += "<a href=\"#" + escaped(id) + "\">" + escaped(id) + "</a> ";
    html += std::string(group.count > group.ids.size() ? "…" : "") + "</td></tr>\n";
  }
  page.insert(html + "</tbody></table></div>\n");
}

void tell_unwritten_pictures(Page& page, const std::vector<Shape>& shapes) {
  const auto lacks = [](const Shape& shape) { return !shape.unwritten_picture.empty(); };
  const auto first = std::ranges::find_if(shapes, lacks);
  if (first == shapes.end()) return;
  page.paragraph(counted(std::ranges::count_if(shapes, lacks), "picture") +
                 " could not be drawn into the folder of the batch: " + first->unwritten_picture);
}

std::string link_to_folder(const std::string& folder, const std::string& page_folder) {
  const fs::path from = fs::absolute(page_folder.empty() ? "." : page_folder).lexically_normal();
  const fs::path to = fs::absolute(folder).lexically_normal();
  std::string link;
  for (const fs::path& part : to.lexically_relative(from)) {
    if (part.empty()) continue;
    link += uri_of_file(part.string()) + "/";
  }
  return link;
}

std::string words_of_steps(const BatchPlan& plan) {
  std::vector<std::string> steps;
  for (const BatchStep& step : plan.steps) steps.push_back(joined(step, " "));
  return joined(steps, " → ");
}

}  // namespace

std::string batch_page(const std::string& folder, const BatchPlan& plan,
                       const BatchPageOptions& options) {
  const std::vector<Shape> shapes = shapes_of(folder, plan, options.threads);
  const BatchStatus status = batch_status(folder, plan, options.threads);
  std::vector<std::string> names;
  for (const BatchItem& item : plan.items) names.push_back(item.id);
  const Figure area("Area distortion: mean |ln ratio| of each shape", shapes, &Shape::area);
  const Figure angle("Angle distortion: mean |ln ratio| of each shape", shapes, &Shape::angle);

  Page page(options.title.empty() ? "Batch of " + counted(std::ssize(names), "shape")
                                  : options.title);
  page.add_style(embedded::batch_page_css);
  add_counts(page, status, shapes);
  add_failures(page, status);
  page.heading("Distortion");
  page.insert("<div class=\"row distributions\">");
  area.add_to(page, names);
  angle.add_to(page, names);
  page.insert("</div>");
  page.heading("Shapes");
  tell_unwritten_pictures(page, shapes);
  page.insert(
      "<noscript><p>The shapes are shown by a script. All figures are in the table that "
      "<code>sphparam batch table</code> writes.</p></noscript>\n<div id=\"shapes\"></div>");
  page.heading("How it was made");
  page.facts({{"plan", plan.name},
              {"steps", words_of_steps(plan)},
              {"folder", fs::absolute(folder).lexically_normal().string()},
              {"program", std::string("sphparam ") + version}});
  Json rows = Json::array();
  for (std::size_t i = 0; i < shapes.size(); ++i)
    rows.push_back(
        row_json(plan.items[i], shapes[i], std::max(area.outlyingness(i), angle.outlyingness(i))));
  page.add_script("const folder = " + Json(link_to_folder(folder, options.page_folder)).dump() +
                  ", rows = " + rows.dump(-1, ' ', false, Json::error_handler_t::replace) + ";");
  page.add_script(embedded::batch_page_js);
  return page.html();
}

}  // namespace sphparam
