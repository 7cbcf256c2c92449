#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "showcase/page_entry.h"
#include "showcase/report_page.h"
#include "support/folder.h"
#include "support/process.h"
#include "support/test_meshes.h"

// The page as its readers meet it: in Chromium, without network. A script that is put into a copy
// of the page uses its controls, looks at the pixels and tells the console what it found;
// then it closes the window, which ends the browser.

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

constexpr char watcher[] = R"js(<script>
const faults = [];
addEventListener('error', e => faults.push(e.message || 'a file is missing'), true);
addEventListener('unhandledrejection', e => faults.push(String(e.reason)));
addEventListener('securitypolicyviolation', e => faults.push('wants ' + e.blockedURI));
setTimeout(() => window.close(), 150000);
console.error = (...words) => faults.push(words.join(' '));
</script>)js";

constexpr char visitor[] = R"js(<script>
addEventListener('load', async () => {
  const wait = time => new Promise(done => setTimeout(done, time));
  const view = document.querySelector('model-viewer');
  for (let i = 0; i < 900 && !view.loaded; ++i) await wait(100);
  await wait(1000);
  const look = async () => {
    for (let frame = 0; frame < 10; ++frame) await new Promise(requestAnimationFrame);
    await wait(500);
    const image = new Image();
    image.src = view.toDataURL();
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  const changed = (a, b) => {  // share of the pixels
    let count = 0;
    for (let i = 0; i < a.length; i += 4) {
      if (Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) +
          Math.abs(a[i + 2] - b[i + 2]) > 24) ++count;
    }
    return count / (a.length / 4);
  };
  const tell = (name, good, what) =>
      console.log('PAGE ' + name + ': ' + (good ? 'ok' : 'BAD') + ' ' + what);
  const morph = document.getElementById('morph');
  const choose = name => document.querySelector('input[value=' + name + ']').click();

  const mesh = await look();
  tell('stands still', changed(mesh, await look()) === 0, '');
  tell('shows the mesh', changed(mesh, new Uint8ClampedArray(mesh.length)) > 0.05, '');
  morph.value = 100;
  morph.dispatchEvent(new Event('input'));
  const sphere = await look();
  tell('slider', changed(mesh, sphere) > 0.02, changed(mesh, sphere));
  tell('slider in words', morph.getAttribute('aria-valuetext') === 'Sphere', '');
  let before = sphere;
  for (const name of ['area', 'angle', 'axes', 'checker']) {
    choose(name);
    const after = await look();
    tell('variant ' + name, changed(before, after) > 0.02, changed(before, after));
    before = after;
  }
  tell('same again', changed(before, sphere) === 0, changed(before, sphere));
  morph.value = 0;
  morph.dispatchEvent(new Event('input'));
  tell('back to the mesh', changed(await look(), mesh) === 0, '');
  document.getElementById('play').click();
  await wait(600);
  tell('play', morph.value > 0, morph.value);
  document.getElementById('play').click();
  const fits = document.documentElement.scrollWidth <= innerWidth;
  tell('fits the window', fits, document.documentElement.scrollWidth + ' of ' + innerWidth);
  const loaded = performance.getEntriesByType('resource').map(entry => entry.name)
      .filter(name => !/^(data|blob):/.test(name));
  tell('loads nothing', loaded.length === 0, loaded.join(' ').slice(0, 300));
  tell('no faults', faults.length === 0, faults.join(' | ').slice(0, 500));
  console.log('PAGE done');
  window.close();
});
</script>)js";

std::string with_visitor(std::string page) {
  page.insert(page.find("<head>") + 6, watcher);
  page.insert(page.rfind("</body>"), visitor);
  return page;
}

/// A shape that is no sphere.
MeshFile stretched() {
  MeshFile file;
  file.mesh = icosphere(3);
  file.mesh.positions.col(0) *= 2;
  file.mesh.positions.col(2) *= 0.6;
  return file;
}

/// What the browser says while it shows a page of that width.
std::string visit(const fs::path& folder, const std::string& page, int width) {
  std::ofstream(folder / "page.html", std::ios::binary) << page;
  const ProcessEnd end = run_process(
      {"/usr/bin/chromium", "--headless=new", "--no-sandbox", "--use-angle=swiftshader",
       "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run",
       "--host-resolver-rules=MAP * ~NOTFOUND", "--user-data-dir=" + (folder / "profile").string(),
       "--enable-logging=stderr", "--window-size=" + std::to_string(width) + ",900",
       "file://" + (folder / "page.html").string()},
      {"HOME=" + folder.string()}, {.seconds = 240});
  return end.messages;
}

}  // namespace

TEST_CASE("page in Chromium: slider, variants and play change what is seen, offline") {
  if (!fs::exists("/usr/bin/chromium")) {
    WARN("skipped: no Chromium");
    return;
  }
  const std::optional<ViewerScript> viewer = installed_viewer();
  if (!viewer) {
    WARN("skipped: no viewer in " << viewer_folder());
    return;
  }
  const MeshFile file = stretched();
  const PageEntry page_entry =
      make_page_entry(entry_of_method(Method::Progressive, file.mesh, {}), {}, file);
  ReportOptions options;
  options.viewer = viewer;
  options.image_width = 512;
  options.look.size = 200;
  const Folder folder;
  const std::string page = with_visitor(report_page("ball", file, {page_entry}, options));
  const std::string messages = visit(folder.path, page, 600);
  INFO(messages);
  CHECK_THAT(messages, Contains("PAGE done") && !Contains("BAD"));
}
