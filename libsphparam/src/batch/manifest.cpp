#include "batch/manifest.h"

#include <filesystem>
#include <limits>

#include "batch/content_hash.h"
#include "batch/engines.h"
#include "batch/record.h"
#include "batch/tables.h"
#include "io/files/file_bytes.h"
#include "io/shell_word.h"
#include "parsed_number.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view format = "#sphparam-batch\t1";
constexpr std::size_t own_columns = 5;

std::string line_of(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) line += '\t';
    line += tsv_field(field);
  }
  return line + "\n";
}

template <class Number>
bool read_whole(const std::string& text, Number& number) {
  const std::optional<Number> whole = parsed<Number>(text);
  if (whole) number = *whole;
  return whole.has_value();
}

class ManifestReader {
 public:
  ManifestReader(std::string_view text, std::string file)
      : lines_(lines_of(text)), file_(std::move(file)) {}

  BatchPlan plan() {
    if (lines_.empty() || lines_.front() != format)
      fail("this is no manifest of `sphparam batch plan`");
    for (at_ = 1; at_ < lines_.size() && lines_[at_].starts_with('#'); ++at_) setting();
    columns();
    for (++at_; at_ < lines_.size(); ++at_) item();
    return std::move(plan_);
  }

 private:
  void setting() {
    std::vector<std::string> fields = tsv_fields(lines_[at_]);
    if (fields.front() == "#step") {
      plan_.steps.emplace_back(fields.begin() + 1, fields.end());
      return;
    }
    const bool is_chunk = fields.front() == "#chunk" && fields.size() == 2;
    if (!is_chunk || !read_whole(fields[1], plan_.chunk) || plan_.chunk < 1)
      fail("a line that this program does not know");
  }

  void columns() {
    if (at_ >= lines_.size()) fail("the line that names the columns is missing");
    const std::vector<std::string> names = tsv_fields(lines_[at_]);
    if (names.size() < own_columns) fail("too few columns");
    plan_.columns.assign(names.begin() + own_columns, names.end());
  }

  void item() {
    std::vector<std::string> fields = tsv_fields(lines_[at_]);
    BatchItem item;
    const bool whole = fields.size() == own_columns + plan_.columns.size();
    if (!whole || !read_whole(fields[2], item.size)) fail("an item that is not whole");
    item.id = std::move(fields[0]);
    item.path = std::move(fields[1]);
    item.input = std::move(fields[3]);
    item.options = std::move(fields[4]);
    item.values.assign(fields.begin() + own_columns, fields.end());
    plan_.items.push_back(std::move(item));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw ReadError::at_line(file_, static_cast<long>(at_) + 1, what);
  }

  std::vector<std::string> lines_;
  std::string file_;
  std::size_t at_ = 0;
  BatchPlan plan_;
};

std::string all_of(const std::string& path) {
  return std::string(FileBytes(path, std::numeric_limits<std::uint64_t>::max()).view());
}

/// Scripts of a batch that was moved still name the folder where it was.
void require_there(const std::string& manifest, const std::string& folder) {
  std::error_code hidden;
  if (fs::exists(folder, hidden)) return;  // a plan that is missing in it is told as any file
  throw ReadError(manifest,
                  "its folder is not there; if it was moved to NEW, `sed -i \"s|" + folder +
                      "|NEW|\" NEW/array.sbatch` mends the script, and `sphparam batch run NEW` "
                      "needs none");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw WriteError(folder.string(), error.message());
}

}  // namespace

std::string manifest_text(const BatchPlan& plan) {
  std::string text = std::string(format) + "\n#chunk\t" + std::to_string(plan.chunk) + "\n";
  for (const BatchStep& step : plan.steps) text += "#step\t" + line_of(step);
  std::vector<std::string> names = {"id", "path", "size", "input", "options"};
  names.insert(names.end(), plan.columns.begin(), plan.columns.end());
  text += line_of(names);
  for (const BatchItem& item : plan.items) {
    std::vector<std::string> fields = {item.id, item.path, std::to_string(item.size), item.input,
                                       item.options};
    fields.insert(fields.end(), item.values.begin(), item.values.end());
    text += line_of(fields);
  }
  return text;
}

BatchPlan parse_manifest(std::string_view text, const std::string& file) {
  return ManifestReader(text, file).plan();
}

std::string manifest_path(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / ("plan-" + name + ".tsv")).string();
}

void save_plan(const std::string& folder, const BatchPlan& plan, const std::string& program) {
  for (const char* const name : {"results", "failed", "staging", "logs"})
    make_folder(fs::path(folder) / name);
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  const std::string manifest = manifest_path(folder, plan.name);
  PendingFiles files;
  std::error_code hidden;
  const auto latest = small_file(path("plan"));
  if (!latest || *latest != plan.name + "\n")  // another plan's results may be there since
    fs::remove_all(fs::path(folder) / "tasks" / plan.name, hidden);
  for (const int task : tasks_marked_open(folder, plan))
    fs::remove(task_mark(folder, plan, task), hidden);
  if (!fs::exists(manifest, hidden)) files.add(manifest, manifest_text(plan));
  const std::string whole = (fs::absolute(folder) / "").lexically_normal().parent_path().string();
  files.add(path("array.sbatch"), slurm_script(whole, plan, program));
  files.add(path("Snakefile"), snakefile(plan, program));
  files.add(path("plan"), plan.name + "\n");
  files.publish();
}

BatchPlan load_plan(const std::string& folder, const std::string& name) {
  std::string wanted = fs::path(name).filename().string();
  if (wanted.starts_with("plan-") && wanted.ends_with(".tsv"))
    wanted = wanted.substr(5, wanted.size() - 9);
  if (wanted.empty()) {
    const std::string latest = (fs::path(folder) / "plan").string();
    std::error_code hidden;
    if (!fs::is_regular_file(latest, hidden))
      throw ReadError(folder, "no batch in this folder; `sphparam batch plan … -o " +
                                  shell_file(folder) + " -- map` makes one");
    wanted = all_of(latest);
    while (wanted.ends_with('\n')) wanted.pop_back();
  }
  const std::string path = manifest_path(folder, wanted);
  require_there(path, folder);
  const std::string text = all_of(path);
  if (content_hash(text).substr(0, 16) != wanted)
    throw ReadError(path, "its bytes are not those of plan " + wanted + ": it was changed");
  BatchPlan plan = parse_manifest(text, path);
  plan.name = wanted;
  return plan;
}

}  // namespace sphparam
