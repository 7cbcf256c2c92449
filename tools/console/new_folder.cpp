#include "console/new_folder.h"

#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

namespace fs = std::filesystem;

NewFolder::~NewFolder() {
  std::error_code holds_something;
  for (const fs::path& folder : made_) fs::remove(folder, holds_something);
}

void NewFolder::make() {
  std::error_code error;
  fs::path missing = (fs::path(path_) / "").lexically_normal();  // however it was spelled
  for (missing = missing.parent_path(); !missing.empty() && !fs::exists(missing, error);
       missing = missing.parent_path())
    made_.push_back(missing);
  fs::create_directories(fs::path(path_).lexically_normal(), error);
  if (error) throw WriteError(path_, error.message());
}

}  // namespace sphparam::cli
