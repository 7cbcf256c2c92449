#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/files/temporary_file.h"
#include "reading.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"
#include "support/folder.h"

using namespace sphparam::tests;
using namespace sphparam;
namespace fs = std::filesystem;

namespace {

/// Another process with a pending file.
class Writer {
 public:
  explicit Writer(const std::string& path) {
    int ready[2];
    REQUIRE(::pipe(ready) == 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      PendingFiles files;
      files.add(path, "of another process");
      static_cast<void>(::write(ready[1], "x", 1));
      for (;;) ::pause();
    }
    ::close(ready[1]);
    char byte = 0;
    CHECK(::read(ready[0], &byte, 1) == 1);
    ::close(ready[0]);
  }
  ~Writer() { kill(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void kill() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    pid_ = 0;
  }

 private:
  pid_t pid_ = 0;
};

/// An open file, locked as those do who are still writing it.
class OpenAndLocked {
 public:
  explicit OpenAndLocked(const std::string& path) : descriptor_(::open(path.c_str(), O_RDONLY)) {
    struct flock everything {};
    everything.l_type = F_RDLCK;
    REQUIRE(::fcntl(descriptor_, F_OFD_SETLK, &everything) == 0);
  }
  ~OpenAndLocked() { ::close(descriptor_); }
  OpenAndLocked(const OpenAndLocked&) = delete;
  OpenAndLocked& operator=(const OpenAndLocked&) = delete;

 private:
  int descriptor_;
};

mode_t mode_of(const std::string& path) {
  struct stat status {};
  REQUIRE(::stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

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

TEST_CASE("pending files: what waits can be read again where it is") {
  const Folder folder;
  const std::string path = folder / "a.txt";
  PendingFiles files;
  CHECK(files.place_of(path).empty());
  files.add(path, "waiting");
  const std::string place = files.place_of(path);
  CHECK(place != path);
  std::ifstream waiting(place);
  std::string text;
  waiting >> text;
  CHECK(text == "waiting");
  CHECK(files.place_of(folder / "./a.txt") == place);
  CHECK(files.place_of("-").empty());
}

TEST_CASE("safe_file: a file holds what was written, and the check saw it on disk") {
  const Folder folder;
  const std::string bytes("a\0b\n", 4);
  std::string seen;
  write_file(folder / "a.ply", bytes, [&](std::string_view read) {
    seen = read;
    CHECK(folder.names().size() == 1);          // the temporary,
    CHECK_FALSE(fs::exists(folder / "a.ply"));  // not yet the file
  });
  CHECK(seen == bytes);
  CHECK(content(folder / "a.ply") == bytes);
  CHECK(folder.names().size() == 1);
  write_file(folder / "empty", "", [](std::string_view read) { CHECK(read.empty()); });
  CHECK(fs::file_size(folder / "empty") == 0);
}

TEST_CASE("safe_file: when the check throws, the old file stays and no temporary does") {
  const Folder folder;
  write_file(folder / "a", "old");
  const auto refuse = [](std::string_view) { throw std::logic_error("not certified"); };
  CHECK_THROWS_AS(write_file(folder / "a", "new", refuse), std::logic_error);
  CHECK_THROWS_AS(write_file(folder / "b", "new", refuse), std::logic_error);
  CHECK(content(folder / "a") == "old");
  CHECK(folder.names().size() == 1);
}

TEST_CASE("safe_file: places that cannot be written are named") {
  using Catch::Matchers::Contains;
  const Folder folder;
  CHECK_THROWS_WITH(write_file(folder.path.string(), "x"), Contains("is a directory"));
  CHECK_THROWS_WITH(write_file(folder / "no/such/a", "x"), Contains("does not exist"));
  CHECK_THROWS_AS(write_file("", "x"), WriteError);
  CHECK_THROWS_AS(write_file("/proc/version", "x"), WriteError);
  if (::geteuid() == 0) return;  // root may write anywhere
  write_file(folder / "a", "old");
  ::chmod((folder / "a").c_str(), 0444);
  CHECK_THROWS_WITH(write_file(folder / "a", "x"), Contains("Permission denied"));
}

TEST_CASE("safe_file: permissions are kept, links are followed") {
  const Folder folder;
  write_file(folder / "a", "old");
  fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("a", folder / "link");
  write_file(folder / "link", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(content(folder / "a") == "new");
  CHECK(fs::status(folder / "a").permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("safe_file: what a killed process left is removed, what a living one writes is not") {
  const Folder folder;
  Writer writer(folder / "a");
  const std::vector<std::string> live = folder.names();
  REQUIRE(live.size() == 1);
  write_file(folder / "b", "x");
  CHECK(folder.names() == std::vector{live.front(), std::string("b")});
  writer.kill();
  write_file(folder / "b", "x");
  CHECK(folder.names() == std::vector<std::string>{"b"});
}

TEST_CASE("safe_file: a folder is looked through for the first of many files, not for each") {
  const Folder folder;
  PendingFiles many;
  many.add(folder / "first", "x");
  Writer writer(folder / "a");
  writer.kill();
  CHECK(folder.names().size() == 2);
  for (const char* const name : {"second", "third"}) many.add(folder / name, "x");
  CHECK(folder.names().size() == 4);  // what was left since the first stays until all have names
  many.publish();
  write_file(folder / "b", "x");
  CHECK(folder.names() == std::vector<std::string>{"b", "first", "second", "third"});
}

TEST_CASE("safe_file: files of strangers stay, whatever they are called") {
  const Folder folder;
  const std::vector<std::string> strangers = {".sphparam-0123456789abcdef01234567.tmp",
                                              ".sphparam-.tmp",
                                              ".sphparam-0123456789abcdef.tmp",
                                              "a.tmp",
                                              "a.tmp.1",
                                              "a.tmp.999999999"};
  for (const std::string& name : strangers) std::ofstream(folder / name) << "x";
  write_file(folder / "a", "new");
  for (const std::string& name : strangers) CHECK(fs::exists(folder / name));
}

TEST_CASE("safe_file: the name of a left file alone is no proof: who holds its lock keeps it") {
  const Folder folder;
  std::string left;
  {
    Writer writer(folder / "a");
    left = folder.names().front();
    writer.kill();
  }
  {
    const OpenAndLocked somebody(folder / left);
    write_file(folder / "a", "x");
    CHECK(fs::exists(folder / left));
  }
  write_file(folder / "a", "x");
  CHECK_FALSE(fs::exists(folder / left));
}

TEST_CASE("safe_file: names may be as long as the file system lets them") {
  const Folder folder;
  const std::string longest(255, 'n');
  write_file(folder / longest, "old");
  write_file(folder / longest, "new");
  CHECK(content(folder / longest) == "new");
  CHECK_THROWS_WITH(write_file(folder / (longest + "n"), "x"), Catch::Contains("too long"));
}

TEST_CASE("safe_file: a new file is as the umask wants it, a replaced one hands on what it had") {
  const Folder folder;
  const mode_t before = ::umask(027);
  write_file(folder / "new", "x");
  ::umask(before);
  CHECK(mode_of(folder / "new") == 0640);
  for (const mode_t mode : {0600, 0644, 0664, 0755}) {
    ::chmod((folder / "new").c_str(), mode);
    write_file(folder / "new", "y");
    CHECK(mode_of(folder / "new") == mode);
  }
}

TEST_CASE("safe_file: attributes of a replaced file are kept, where the file system has them") {
  const Folder folder;
  write_file(folder / "a", "old");
  if (::setxattr((folder / "a").c_str(), "user.note", "mine", 4, 0) != 0) {
    WARN("skipped: this file system has no attributes of users");
    return;
  }
  write_file(folder / "a", "new");
  char value[8] = {};
  CHECK(::getxattr((folder / "a").c_str(), "user.note", value, sizeof value) == 4);
  CHECK(std::string(value) == "mine");
}

TEST_CASE("safe_file: owner and group of a replaced file are kept by who may give them") {
  if (::geteuid() != 0) {
    WARN("skipped: only root may give files to others");
    return;
  }
  const Folder folder;
  for (const uid_t owner : {uid_t{1234}, ::geteuid()}) {
    write_file(folder / "a", "old");
    REQUIRE(::chown((folder / "a").c_str(), owner, 2345) == 0);
    ::chmod((folder / "a").c_str(), 04754);
    write_file(folder / "a", "new");
    struct stat status {};
    REQUIRE(::stat((folder / "a").c_str(), &status) == 0);
    CHECK(status.st_uid == owner);
    CHECK(status.st_gid == 2345);
    CHECK(mode_of(folder / "a") == 04754);
    fs::remove(folder / "a");  // the next one is no heir of it
  }
}

TEST_CASE("safe_file: a file that may not be read is replaced all the same, and stays so") {
  const Folder folder;
  write_file(folder / "a", "old");
  ::chmod((folder / "a").c_str(), 0200);
  write_file(folder / "a", "new");
  CHECK(mode_of(folder / "a") == 0200);
}

TEST_CASE("safe_file: other names of a replaced file keep the old bytes") {
  const Folder folder;
  write_file(folder / "a", "old");
  fs::create_hard_link(folder / "a", folder / "other");
  write_file(folder / "a", "new");
  CHECK(content(folder / "a") == "new");
  CHECK(content(folder / "other") == "old");
}

TEST_CASE("safe_file: a file written piece by piece is read back where it is") {
  const Folder folder;
  PendingFiles files;
  const PendingFiles::Pieces file = files.open(folder / "a");
  file.write(3, "def");
  file.write(0, "abc");
  char bytes[8] = {};
  CHECK(file.read(1, bytes, sizeof bytes) == 5);
  CHECK(std::string(bytes) == "bcdef");
  CHECK(file.read(100, bytes, sizeof bytes) == 0);
  files.publish();
  CHECK(content(folder / "a") == "abcdef");
}

TEST_CASE("safe_file: what was written and cannot be parsed is told of the file that was wanted") {
  const Folder folder;
  const auto refuse = [](std::string_view) -> void { throw ReadError("a", "is no mesh"); };
  CHECK_THROWS_AS(write_file(folder / "a", "x", refuse), WriteError);
  CHECK_THROWS_WITH(write_file(folder / "a", "x", refuse),
                    Catch::Contains(folder / "a") && !Catch::Contains(".sphparam-"));
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
  write_file(folder / "a", "old");
  PendingFiles files;
  files.add(folder / "a", "new a");
  files.add(folder / "b", "new b");
  CHECK(content(folder / "a") == "old");
  CHECK_FALSE(fs::exists(folder / "b"));
  files.publish();
  CHECK(content(folder / "a") == "new a");
  CHECK(content(folder / "b") == "new b");
  CHECK(folder.names().size() == 2);
}

TEST_CASE("safe_file: pending files that are given up leave nothing") {
  const Folder folder;
  write_file(folder / "a", "old");
  {
    PendingFiles files;
    files.add(folder / "a", "new a");
    files.add(folder / "b", "new b");
    CHECK_THROWS_AS(files.add(folder / "no/c", "new c"), WriteError);
  }
  CHECK(content(folder / "a") == "old");
  CHECK(folder.names().size() == 1);
}

TEST_CASE("safe_file: nothing stays open of files that were written, replaced or given up") {
  const Folder folder;
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = open_files();
  write_file(folder / "a", "old");
  CHECK(open_files() == before);
  write_file(folder / "a", "new");
  CHECK(open_files() == before);
  {
    PendingFiles files;
    files.add(folder / "a", "newer");
    files.open(folder / "b").write(0, "in pieces");
    CHECK(open_files() > before);
  }
  CHECK(open_files() == before);
}

TEST_CASE("safe_file: when one file cannot take its name, the others give theirs back") {
  const Folder folder;
  write_file(folder / "a", "old");
  {
    PendingFiles files;
    files.add(folder / "a", "new a");
    files.add(folder / "b", "new b");
    files.add(folder / "c", "new c");
    files.add(folder / "d", "new d");
    for (const std::string& name : folder.names())
      if (content(folder / name) == "new c") fs::remove(folder / name);
    CHECK_THROWS_AS(files.publish(), WriteError);
  }
  CHECK(content(folder / "a") == "old");
  CHECK(folder.names().size() == 1);
}

TEST_CASE("safe_file: two spellings of one path are one file") {
  const Folder folder;
  fs::create_symlink(folder / "a", folder / "link");
  fs::create_directory(folder / "sub");
  PendingFiles files;
  files.add(folder / "a", "x");
  for (const char* spelling : {"a", "./a", "sub/../a", "link"})
    CHECK_THROWS_WITH(files.add(folder / spelling, "y"), Catch::Contains("two outputs"));
}

TEST_CASE("safe_file: a name without folder and one with a point before it are one file") {
  const Folder folder;
  const WorkingFolder working(folder.path);
  PendingFiles files;
  files.add("new", "x");
  CHECK_THROWS_WITH(files.add("./new", "y"), Catch::Contains("two outputs"));
  CHECK_THROWS_WITH(files.add(folder / "new", "y"), Catch::Contains("two outputs"));
}

TEST_CASE("safe_file: a link to nothing is followed, and stays") {
  const Folder folder;
  fs::create_directory(folder / "sub");
  fs::create_symlink("sub/a", folder / "link");
  fs::create_symlink("link", folder / "second");
  write_file(folder / "second", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(fs::is_symlink(folder / "second"));
  CHECK(content(folder / "sub/a") == "new");
  fs::create_symlink("no/such", folder / "lost");
  CHECK_THROWS_WITH(write_file(folder / "lost", "x"), Catch::Contains("does not exist"));
  fs::create_symlink("loop", folder / "loop");
  CHECK_THROWS_AS(write_file(folder / "loop", "x"), WriteError);
}

TEST_CASE("safe_file: a signal handler can remove the temporaries that are there") {
  const Folder folder;
  // As many as are known at once have come and gone: they take no places.
  for (int i = 0; i < 64; ++i) write_file(folder / "old", "x");
  PendingFiles files;
  for (const char* name : {"a", "b", "c", "d", "e"}) files.add(folder / name, "x");
  CHECK(folder.names().size() == 6);
  remove_temporaries_on_signal();
  CHECK(folder.names() == std::vector<std::string>{"old"});
}

TEST_CASE("safe_file: a file that is read is never replaced, by whatever name") {
  const Folder folder;
  write_file(folder / "input", "old");
  write_file(folder / "output", "old");
  fs::create_symlink("input", folder / "link");
  fs::create_hard_link(folder / "input", folder / "other");
  // Kept by its number until the process ends: no file of a later test may get that.
  static const OpenAndLocked forever(folder / "input");
  keep_from_outputs({folder / "no such file", folder / "input"});
  for (const char* name : {"input", "./input", "link", "other"}) {
    const std::string path = folder / name;
    CHECK_THROWS_WITH(write_file(path, "new"),
                      path + ": is read by this command; it would be replaced");
    CHECK_THROWS_AS(require_writable(path), WriteError);
    CHECK(content(path) == "old");
  }
  write_file(folder / "output", "new");
  CHECK(content(folder / "output") == "new");
}

TEST_CASE("safe_file: streams are written when the files get their names") {
  const Folder folder;
  PendingFiles files;
  files.add("/dev/full", "x");
  files.add(folder / "a", "x");
  CHECK_THROWS_AS(files.publish(), WriteError);
  CHECK_FALSE(fs::exists(folder / "a"));
}
