#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "batch/record.h"
#include "sphparam/batch/results.h"
#include "support/folder.h"
#include "support/process.h"

// The page of a batch in headless Chromium: a script in a copy of it uses its controls and tells
// the console what it found; then it closes the window, which ends the browser.

namespace sphparam::tests {

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

constexpr char visitor[] = R"js(<script>
const faults = [];
addEventListener('error', e => faults.push(e.message || 'a file is missing'));
addEventListener('securitypolicyviolation', e => faults.push('wants ' + e.blockedURI));
addEventListener('load', async () => {
  const wait = time => new Promise(done => setTimeout(done, time));
  const tell = (name, good, what) =>
      console.log('PAGE ' + name + ': ' + (good ? 'ok' : 'BAD') + ' ' + what);
  const names = () => [...document.querySelectorAll('.card h3')].map(e => e.textContent);
  const set = (selector, value, event) => {
    const control = document.querySelector(selector);
    control.value = value;
    control.dispatchEvent(new Event(event));
  };
  tell('a leaf at a time', names().length === 60, names().length);
  tell('outliers first', names()[0] === 'i0777', names()[0]);
  tell('counts', document.querySelector('output').textContent === '1–60 of 1,000', '');
  document.querySelectorAll('.controls button')[1].click();
  tell('leafs', document.querySelector('output').textContent === '61–120 of 1,000', '');
  set('[data-key=which]', 'failed', 'change');
  tell('failed', names().length === 30, names().length);
  tell('reasons', document.querySelector('.card').textContent.includes('code 4: a <hole>'), '');
  set('[data-key=which]', 'repaired', 'change');
  tell('repaired', names().join() === 'i0555', names().join());
  tell('repairs', document.querySelector('.badge.repaired').textContent === 'repaired' &&
      document.querySelector('.card').textContent.includes('hole-filled 1; handle-cut 2'), '');
  set('[data-key=which]', 'wrapped', 'change');
  tell('wrapped', names().join() === 'i0666' &&
      document.querySelector('.badge.repaired').textContent === 'wrapped', names().join());
  set('[data-key=which]', 'warned', 'change');
  tell('warned', names().join() === 'i0444' &&
      document.querySelector('.card').textContent.includes('warning: m.ply is <turned>'), '');
  set('[data-key=which]', 'all', 'change');
  set('.controls input', 'TURNED', 'input');
  tell('search for a warning', names().join() === 'i0444', names().join());
  set('.controls input', '', 'input');
  set('[data-key=order]', 'area', 'change');
  tell('order', names()[0] === 'i0777', names()[0]);
  set('.controls input', 'i0123', 'input');
  tell('search', names().join() === 'i0123', names().join());
  location.hash = '#i0500';
  await wait(100);
  tell('a link to a shape', document.querySelector('.card.chosen h3').textContent === 'i0500', '');
  const fits = document.documentElement.scrollWidth <= innerWidth;
  tell('fits the window', fits, document.documentElement.scrollWidth + ' of ' + innerWidth);
  tell('no faults', faults.length === 0, faults.join(' | '));
  console.log('PAGE done');
  window.close();
});
</script>)js";

/// A thousand shapes as a batch leaves them, thirty failed, one far out.
BatchPlan write_batch(const fs::path& folder) {
  BatchPlan plan{.steps = {{"map", "{input}"}}};
  for (int i = 0; i < 1000; ++i) {
    const std::string number = std::to_string(10000 + i).substr(1);
    BatchItem item{.id = "i" + number, .path = "/m.ply", .input = "x", .options = "y"};
    BatchRecord record;
    record.id = item.id;
    record.head.planned = record.head.input = "x";
    record.head.options = "y";
    const bool failed = i % 33 == 1 && i < 991;
    record.head.outcome = failed ? BatchOutcome::Failed : BatchOutcome::Certified;
    if (failed) record.head.code = 4, record.head.reason = "a <hole>";
    if (i == 444) record.head.warnings = {"/m.ply is <turned>"};
    if (i == 555) record.head.repairs = "hole-filled 1; handle-cut 2";
    if (i == 666) record.head.repairs = "wrapped 1";
    const double area = i == 777 ? 9 : 0.2 + 0.0001 * i;
    record.steps.push_back({{"map"},
                            0,
                            1,
                            R"({"distortion":{"mean_abs_ln_area":)" + std::to_string(area) +
                                R"(,"mean_abs_ln_angle":0.1})" +
                                (i == 888 ? R"(,"inspection":{"vertices":10242}})" : "}")});
    const fs::path place = failed
                               ? fs::path(failure_path(folder.string(), item.id))
                               : fs::path(result_folder(folder.string(), item.id)) / "record.json";
    fs::create_directories(place.parent_path());
    std::ofstream(place) << to_json(record);
    plan.items.push_back(std::move(item));
  }
  return plan;
}

std::string visit(const fs::path& folder, const std::string& page, int width) {
  std::ofstream(folder / "page.html", std::ios::binary) << page;
  return run_process(
             {"/usr/bin/chromium", "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
              "--no-first-run", "--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND",
              "--user-data-dir=" + (folder / "profile").string(), "--enable-logging=stderr",
              "--window-size=" + std::to_string(width) + ",900",
              "file://" + (folder / "page.html").string()},
             {"HOME=" + folder.string()}, {.seconds = 120})
      .messages;
}

}  // namespace

TEST_CASE("batch page in Chromium: a thousand shapes are sorted, filtered, searched and linked") {
  const Folder folder;
  const BatchPlan plan = write_batch(folder.path);
  std::string page =
      batch_page(folder.path.string(), plan, {.page_folder = folder.path.string(), .title = "all"});
  CHECK_THAT(page, Contains("Outliers: <a href=\"#i0777\">") && Contains("a &lt;hole&gt;"));
  CHECK_THAT(page, Contains(",10242,0.2888,0.1,"));  // a count is whole, a measure is rounded
  if (!fs::exists("/usr/bin/chromium")) {
    WARN("skipped: no Chromium");
    return;
  }
  page.insert(page.rfind("</body>"), visitor);
  for (const int width : {500, 1280}) {
    const std::string messages = visit(folder.path, page, width);
    INFO(messages);
    CHECK_THAT(messages, Contains("PAGE done") && !Contains("BAD"));
  }
}

}  // namespace sphparam::tests
