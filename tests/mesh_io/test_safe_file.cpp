#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mesh_io/safe_file.h"
#include "mesh_io/temporary_file.h"
#include "reading.h"

using namespace sphparam::tests;
using namespace sphparam::tools;
namespace fs = std::filesystem;

namespace {

/// A new folder that is gone at the end.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "sphparam_test_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  std::string file(const std::string& name) const { return (path / name).string(); }
  long entries() const {
    return std::distance(fs::directory_iterator(path), fs::directory_iterator());
  }
};

/// The working folder while it lives.
class WorkingFolder {
 public:
  explicit WorkingFolder(const fs::path& folder) { fs::current_path(folder); }
  ~WorkingFolder() { fs::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  fs::path before_ = fs::current_path();
};

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("safe_file: a file holds what was written, and the check saw it on disk") {
  const Folder folder;
  const std::string bytes("a\0b\n", 4);
  std::string seen;
  write_file(folder.file("a.ply"), bytes, [&](std::string_view read) {
    seen = read;
    CHECK(folder.entries() == 1);                   // the temporary,
    CHECK_FALSE(fs::exists(folder.file("a.ply")));  // not yet the file
  });
  CHECK(seen == bytes);
  CHECK(content(folder.file("a.ply")) == bytes);
  CHECK(folder.entries() == 1);
  write_file(folder.file("empty"), "", [](std::string_view read) { CHECK(read.empty()); });
  CHECK(fs::file_size(folder.file("empty")) == 0);
}

TEST_CASE("safe_file: when the check throws, the old file stays and no temporary does") {
  const Folder folder;
  write_file(folder.file("a"), "old");
  const auto refuse = [](std::string_view) { throw std::logic_error("not certified"); };
  CHECK_THROWS_AS(write_file(folder.file("a"), "new", refuse), std::logic_error);
  CHECK_THROWS_AS(write_file(folder.file("b"), "new", refuse), std::logic_error);
  CHECK(content(folder.file("a")) == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("safe_file: places that cannot be written are named") {
  using Catch::Matchers::Contains;
  const Folder folder;
  CHECK_THROWS_WITH(write_file(folder.path.string(), "x"), Contains("is a directory"));
  CHECK_THROWS_WITH(write_file(folder.file("no/such/a"), "x"), Contains("does not exist"));
  CHECK_THROWS_AS(write_file("", "x"), WriteError);
  CHECK_THROWS_AS(write_file("/proc/version", "x"), WriteError);
  if (::geteuid() == 0) return;  // root may write anywhere
  write_file(folder.file("a"), "old");
  ::chmod(folder.file("a").c_str(), 0444);
  CHECK_THROWS_WITH(write_file(folder.file("a"), "x"), Contains("Permission denied"));
}

TEST_CASE("safe_file: permissions are kept, links are followed") {
  const Folder folder;
  write_file(folder.file("a"), "old");
  fs::permissions(folder.file("a"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("a", folder.file("link"));
  write_file(folder.file("link"), "new");
  CHECK(fs::is_symlink(folder.file("link")));
  CHECK(content(folder.file("a")) == "new");
  CHECK(fs::status(folder.file("a")).permissions() ==
        (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("safe_file: temporaries of killed processes are removed, others stay") {
  const Folder folder;
  const std::string dead = folder.file("a.tmp.999999999"), alive = folder.file("a.tmp.1"),
                    other = folder.file("b.tmp.999999999"), odd = folder.file("a.tmp.9x");
  for (const std::string& name : {dead, alive, other, odd}) std::ofstream(name) << "x";
  write_file(folder.file("a"), "new");
  CHECK_FALSE(fs::exists(dead));
  CHECK(fs::exists(alive));
  CHECK(fs::exists(other));
  CHECK(fs::exists(odd));
}

TEST_CASE("safe_file: devices are written directly, after the check") {
  bool checked = false;
  write_file("/dev/null", "x", [&](std::string_view bytes) { checked = bytes == "x"; });
  CHECK(checked);
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_AS(write_file("/dev/full", "x"), WriteError);
}

TEST_CASE("safe_file: nothing reaches standard output when the check throws") {
  const auto refuse = [](std::string_view) { throw std::logic_error("not certified"); };
  CHECK_THROWS_AS(write_file("-", "must not appear\n", refuse), std::logic_error);
}

TEST_CASE("safe_file: pending files get their names together, and not before") {
  const Folder folder;
  write_file(folder.file("a"), "old");
  PendingFiles files;
  files.add(folder.file("a"), "new a");
  files.add(folder.file("b"), "new b");
  CHECK(content(folder.file("a")) == "old");
  CHECK_FALSE(fs::exists(folder.file("b")));
  files.publish();
  CHECK(content(folder.file("a")) == "new a");
  CHECK(content(folder.file("b")) == "new b");
  CHECK(folder.entries() == 2);
}

TEST_CASE("safe_file: pending files that are given up leave nothing") {
  const Folder folder;
  write_file(folder.file("a"), "old");
  {
    PendingFiles files;
    files.add(folder.file("a"), "new a");
    files.add(folder.file("b"), "new b");
    CHECK_THROWS_AS(files.add(folder.file("no/c"), "new c"), WriteError);
  }
  CHECK(content(folder.file("a")) == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("safe_file: when one file cannot take its name, the others give theirs back") {
  const Folder folder;
  write_file(folder.file("a"), "old");
  {
    PendingFiles files;
    files.add(folder.file("a"), "new a");
    files.add(folder.file("b"), "new b");
    files.add(folder.file("c"), "new c");
    files.add(folder.file("d"), "new d");
    fs::remove(folder.file("c.tmp." + std::to_string(::getpid())));
    CHECK_THROWS_AS(files.publish(), WriteError);
  }
  CHECK(content(folder.file("a")) == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("safe_file: two spellings of one path are one file") {
  const Folder folder;
  fs::create_symlink(folder.file("a"), folder.file("link"));
  fs::create_directory(folder.file("sub"));
  PendingFiles files;
  files.add(folder.file("a"), "x");
  for (const char* spelling : {"a", "./a", "sub/../a", "link"})
    CHECK_THROWS_WITH(files.add(folder.file(spelling), "y"), Catch::Contains("two outputs"));
}

TEST_CASE("safe_file: a name without folder and one with a point before it are one file") {
  const Folder folder;
  const WorkingFolder working(folder.path);
  PendingFiles files;
  files.add("new", "x");
  CHECK_THROWS_WITH(files.add("./new", "y"), Catch::Contains("two outputs"));
  CHECK_THROWS_WITH(files.add(folder.file("new"), "y"), Catch::Contains("two outputs"));
}

TEST_CASE("safe_file: a link to nothing is followed, and stays") {
  const Folder folder;
  fs::create_directory(folder.file("sub"));
  fs::create_symlink("sub/a", folder.file("link"));
  fs::create_symlink("link", folder.file("second"));
  write_file(folder.file("second"), "new");
  CHECK(fs::is_symlink(folder.file("link")));
  CHECK(fs::is_symlink(folder.file("second")));
  CHECK(content(folder.file("sub/a")) == "new");
  fs::create_symlink("no/such", folder.file("lost"));
  CHECK_THROWS_WITH(write_file(folder.file("lost"), "x"), Catch::Contains("does not exist"));
  fs::create_symlink("loop", folder.file("loop"));
  CHECK_THROWS_AS(write_file(folder.file("loop"), "x"), WriteError);
}

TEST_CASE("safe_file: a signal handler can remove the temporaries that are there") {
  const Folder folder;
  PendingFiles files;
  files.add(folder.file("a"), "x");
  files.add(folder.file("b"), "y");
  CHECK(folder.entries() == 2);
  remove_temporaries_on_signal();
  CHECK(folder.entries() == 0);
}

TEST_CASE("safe_file: streams are written when the files get their names") {
  const Folder folder;
  PendingFiles files;
  files.add("/dev/full", "x");
  files.add(folder.file("a"), "x");
  CHECK_THROWS_AS(files.publish(), WriteError);
  CHECK_FALSE(fs::exists(folder.file("a")));
}
