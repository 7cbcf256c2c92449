// Loaded into the program with LD_PRELOAD: makes the n-th call of one kind fail. The environment
// says which: SPHPARAM_FAULT="CALL N ACTION", where CALL is malloc (also operator new), open, read,
// write (also at a place), fsync, fcntl, close, rename, mkdir, map (a file into memory), thread
// (its creation) or load (a module), N counts from 1, and ACTION is
//   E<errno>     fails with this error            A<errno>    so do all later calls
//   short        writes half                      S<signal>   raises a signal before the call
//   T<signal>    raises it after the call
// SPHPARAM_FAULT_LOG names a file that gets a byte when the fault happens, SPHPARAM_FAULT_COUNTS
// one that gets "CALL COUNT" lines at the end.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum Call {
  Malloc,
  Open,
  Read,
  Write,
  Fsync,
  Fcntl,
  Close,
  Rename,
  MakeFolder,
  MapFile,
  Thread,
  Load,
  CallCount
};
constexpr const char* names[CallCount] = {"malloc", "open",   "read",  "write", "fsync",  "fcntl",
                                          "close",  "rename", "mkdir", "map",   "thread", "load"};

struct Fault {
  int call = -1;
  long nth = 0;
  char action = 0;
  int number = 0;  // errno or signal
};

Fault fault;
std::array<std::atomic<long>, CallCount> calls{};
std::atomic<bool> ready{false};
std::atomic<int> loading{0};  // modules, just now

void log_fault() {
  const char* const path = std::getenv("SPHPARAM_FAULT_LOG");
  if (!path) return;
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND, 0600);
  syscall(SYS_write, file, "x", 1);
  syscall(SYS_close, file);
}

/// Counts the call. The fault, if this is its turn.
const Fault* turn(Call call) {
  if (!ready.load(std::memory_order_relaxed)) return nullptr;
  if ((call == Malloc || call == Thread) && loading > 0) return nullptr;
  const long count = calls[call].fetch_add(1) + 1;
  if (call != fault.call) return nullptr;
  const bool now = count == fault.nth || (fault.action == 'A' && count > fault.nth);
  if (!now) return nullptr;
  if (count == fault.nth) log_fault();
  if (fault.action == 'S') raise(fault.number);
  return &fault;
}

bool fails(const Fault* due) {
  if (!due || (due->action != 'E' && due->action != 'A')) return false;
  errno = due->number;
  return true;
}

template <class Result>
Result after(const Fault* due, Result result) {
  const int error = errno;
  if (due && due->action == 'T') raise(due->number);
  errno = error;
  return result;
}

void read_environment() {
  if (const char* const text = std::getenv("SPHPARAM_FAULT")) {
    char call[16] = {};
    std::sscanf(text, "%15s %ld %c%d", call, &fault.nth, &fault.action, &fault.number);
    for (int i = 0; i < CallCount; ++i)
      if (std::strcmp(call, names[i]) == 0) fault.call = i;
  }
}

using Main = int (*)(int, char**, char**);
Main real_main = nullptr;

int main_with_faults(int argc, char** argv, char** environment) {
  read_environment();
  ready = true;
  const int code = real_main(argc, argv, environment);
  ready = false;
  return code;
}

__attribute__((destructor)) void finish() {
  ready = false;
  const char* const path = std::getenv("SPHPARAM_FAULT_COUNTS");
  std::FILE* const file = path ? std::fopen(path, "w") : nullptr;
  if (!file) return;
  for (int i = 0; i < CallCount; ++i) std::fprintf(file, "%s %ld\n", names[i], calls[i].load());
  std::fclose(file);
}

}  // namespace

extern "C" {

// Nothing is counted before main, and neither allocations nor threads while a module is loaded:
// what static objects do there, those of some fifty libraries behind one for images, cannot be
// caught by anybody, and one of them waits for ever for a thread that there is not.
int __libc_start_main(Main program, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  real_main = program;
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(main_with_faults, argc, argv, init, fini, rtld_fini, stack_end);
}

void* malloc(std::size_t size) { return fails(turn(Malloc)) ? nullptr : __libc_malloc(size); }

void* calloc(std::size_t count, std::size_t size) {
  return fails(turn(Malloc)) ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  return fails(turn(Malloc)) ? nullptr : __libc_realloc(old, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails(turn(Malloc)) ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  if (fails(turn(Malloc))) return ENOMEM;
  *result = __libc_memalign(alignment, size);
  return *result ? 0 : ENOMEM;
}

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0;
  va_end(list);
  const Fault* const due = turn(Open);
  if (fails(due)) return -1;
  return after(due, static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode)));
}

int open64(const char* path, int flags, ...) __attribute__((alias("open")));

ssize_t write(int file, const void* bytes, std::size_t count) {
  const Fault* const due = turn(Write);
  if (fails(due)) return -1;
  if (due && due->action == 's') count = (count + 1) / 2;
  return after(due, syscall(SYS_write, file, bytes, count));
}

ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t at) {
  const Fault* const due = turn(Write);
  if (fails(due)) return -1;
  if (due && due->action == 's') count = (count + 1) / 2;
  return after(due, syscall(SYS_pwrite64, file, bytes, count, at));
}

ssize_t pwrite64(int file, const void* bytes, std::size_t count, off_t at)
    __attribute__((alias("pwrite")));

ssize_t read(int file, void* bytes, std::size_t count) {
  const Fault* const due = turn(Read);
  return fails(due) ? -1 : after(due, syscall(SYS_read, file, bytes, count));
}

ssize_t pread(int file, void* bytes, std::size_t count, off_t at) {
  const Fault* const due = turn(Read);
  return fails(due) ? -1 : after(due, syscall(SYS_pread64, file, bytes, count, at));
}

ssize_t pread64(int file, void* bytes, std::size_t count, off_t at) __attribute__((alias("pread")));

int mkdir(const char* path, mode_t mode) noexcept {
  const Fault* const due = turn(MakeFolder);
  return fails(due) ? -1 : after(due, static_cast<int>(syscall(SYS_mkdir, path, mode)));
}

// Of files alone: what the C library maps for itself does not come by.
void* mmap(void* where, std::size_t size, int protection, int flags, int file, off_t at) noexcept {
  const Fault* const due = file >= 0 ? turn(MapFile) : nullptr;
  if (fails(due)) return MAP_FAILED;
  return after(
      due, reinterpret_cast<void*>(syscall(SYS_mmap, where, size, protection, flags, file, at)));
}

void* mmap64(void* where, std::size_t size, int protection, int flags, int file, off_t at) noexcept
    __attribute__((alias("mmap")));

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*begin)(void*),
                   void* argument) noexcept {
  const Fault* const due = turn(Thread);
  if (fails(due)) return due->number;
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return after(due, create(thread, attributes, begin, argument));
}

void* dlopen(const char* path, int mode) noexcept {
  const Fault* const due = turn(Load);
  using Open = void* (*)(const char*, int);
  static const auto open_module = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "dlopen"));
  // A failure as the loader has them, so that dlerror knows of it.
  ++loading;
  void* const module = open_module(fails(due) ? "/no module" : path, mode);
  --loading;
  return after(due, module);
}

int fsync(int file) {
  const Fault* const due = turn(Fsync);
  return fails(due) ? -1 : after(due, static_cast<int>(syscall(SYS_fsync, file)));
}

// Locks, and second descriptors of a file.
int fcntl(int file, int command, ...) {
  va_list list;
  va_start(list, command);
  void* const argument = va_arg(list, void*);
  va_end(list);
  const Fault* const due = turn(Fcntl);
  if (fails(due)) return -1;
  return after(due, static_cast<int>(syscall(SYS_fcntl, file, command, argument)));
}

int fcntl64(int file, int command, ...) __attribute__((alias("fcntl")));

// A close that fails has closed.
int close(int file) {
  const Fault* const due = turn(Close);
  const int result = static_cast<int>(syscall(SYS_close, file));
  return fails(due) ? -1 : after(due, result);
}

int rename(const char* from, const char* to) {
  const Fault* const due = turn(Rename);
  if (fails(due)) return -1;
  return after(due, static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0)));
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  const Fault* const due = turn(Rename);
  if (fails(due)) return -1;
  return after(due,
               static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags)));
}
}
