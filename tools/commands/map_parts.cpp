// `sphparam map --all-components`: a map a part.

#include "commands/map_parts.h"

#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "arguments/part_files.h"
#include "commands/data_files.h"
#include "commands/map_outputs.h"
#include "commands/sources.h"
#include "console/exit_codes.h"
#include "number_text.h"
#include "reports/map_wording.h"
#include "sphparam/errors.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

/// Files wait open for their names, of thousands of parts more than most systems begin with.
void allow_many_files() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// What may be left out of all.
double least_kept(const MapArguments& arguments) {
  const std::optional<RepairOptions> repairs = wanted_repairs(arguments.repair);
  return repairs && repairs->components ? repairs->least_kept : 1;
}

std::string reasons_of(const MeshError& error) {
  Words reasons;
  for (const MeshDefect& defect : error.defects())
    if (defect.fatal) reasons.push_back(defect.message);
  return joined(reasons, "; ");
}

class PartsRun {
 public:
  PartsRun(const MapArguments& arguments, Session& session,
           const std::function<MapOutcome(MeshPart)>& map)
      : arguments_(arguments), session_(session), map_(map) {}

  int run() {
    allow_many_files();
    MeshSource source = sphparam::read_source(arguments_.input, limits_for(arguments_.repair));
    attach_data_files(source.file, source.path, arguments_.data, MissingValues::LeftOut, session_);
    mark_ = mark_of(source.file.mesh);
    std::vector<MeshPart> parts = connected_parts(
        std::move(source), wanted_repairs(arguments_.repair).value_or(RepairOptions::none()));
    if (!parts.empty()) {
      for (const RepairAction& done : parts.front().source.repairs) {
        session_.console.say("  " + done.message);
      }
    }
    count_ = parts.size();
    for (size_t i = 0; i < count_; ++i) map_part(i + 1, std::move(parts[i]));
    if (refused_ && (written_ == 0 || 1 - lost_ < least_kept(arguments_))) {
      session_.console.error(first_refused_ + " cannot be mapped: nothing is written" +
                             (written_ > 0 ? ", not even the maps told above" : ""));
      std::rethrow_exception(refused_);
    }
    session_.add_report([&] { return report_of_parts("map", reports_); });
    session_.publish();
    tell();
    return code_;
  }

 private:
  std::string name_of(size_t number, const MeshPart& part) const {
    return "component " + std::to_string(number) + " of " + std::to_string(count_) + " (" +
           percent(part.area_share) + " of the area, " +
           counted(static_cast<long>(part.source.file.mesh.face_count()), "triangle", "triangles") +
           (part.is_cavity ? ", a cavity within component 1)" : ")");
  }

  void map_part(size_t number, MeshPart part) {
    const std::string name = name_of(number, part);
    const double share = part.area_share;
    try {
      MapOutcome outcome = map_(std::move(part));
      session_.console.say(name + ":");
      tell_stages(outcome, session_.console);
      add(number, outcome);
    } catch (const MeshError& error) {
      leave_out(name, share, reasons_of(error));
    } catch (const UnmeasurableMesh& error) {  // a speck without area
      leave_out(name, share, error.what());
    }
  }

  /// Requires: the exception that says why is being handled.
  void leave_out(const std::string& name, double share, const std::string& why) {
    session_.console.say(name + " cannot be mapped: " + why);
    lost_ += share;
    if (!refused_) {
      refused_ = std::current_exception();
      first_refused_ = name;
    }
    left_out_.push_back(name);
  }

  void add(size_t number, MapOutcome& outcome) {
    const bool writes = outcome.has_map() && outcome.frame.holds() &&
                        (outcome.bijective() || arguments_.keep_folded);
    MapArguments of_part = arguments_;
    of_part.output = path_of_part(arguments_.output, static_cast<int>(number));
    of_part.component = component_words(number, count_, mark_);
    if (writes) files_.push_back(static_cast<int>(number));
    const std::string report = add_outputs(of_part, outcome, writes, session_);
    if (!report.empty()) reports_ += (reports_.empty() ? "" : ", ") + report;
    tell_result(outcome, writes ? of_part.output : "", session_.stopwatch.seconds(),
                session_.console, ", once all components are done");
    if (!outcome.succeeded()) code_ = NotCertified;
    ++written_;
  }

  void tell() const {
    for (const int number : parts_on_disk(arguments_.output)) {
      if (std::ranges::find(files_, number) != files_.end()) continue;
      session_.console.warning(path_of_part(arguments_.output, number) +
                               " is of an earlier run: remove it before bake or export "
                               "--all-components");
    }
    if (!files_.empty())
      session_.console.say("  " + counted(static_cast<long>(files_.size()), "map") + " written");
    if (left_out_.empty()) return;
    session_.console.say("  left out: " + joined(left_out_) +
                         ", which cannot be mapped: " + percent(lost_) + " of the area");
  }

  const MapArguments& arguments_;
  Session& session_;
  const std::function<MapOutcome(MeshPart)>& map_;
  size_t count_ = 0, written_ = 0;
  double lost_ = 0;
  std::string mark_;
  std::vector<int> files_;
  std::vector<std::string> left_out_;
  std::exception_ptr refused_;
  std::string first_refused_, reports_;
  int code_ = Ok;
};

}  // namespace

int run_map_of_parts(const MapArguments& arguments, Session& session,
                     const std::function<MapOutcome(MeshPart)>& map) {
  return PartsRun(arguments, session, map).run();
}

}  // namespace sphparam::cli
