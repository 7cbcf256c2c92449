#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/content_hash.h"
#include "sphparam/batch/plan.h"

namespace sphparam {

enum class BatchOutcome {
  Certified,  // all steps ended well, and a map is proved one-to-one
  Done,       // all steps ended well; none of them makes or takes a map
  Failed,
};

/// A file among the results of an item.
struct BatchFile {
  std::string name;  // below results/ID
  std::uint64_t size = 0;
  std::string hash;
};

/// What decides whether an item is run: the beginning of its record.
struct BatchRecordHead {
  BatchOutcome outcome = BatchOutcome::Failed;
  int code = 0;           // of the step that failed; 128 + N: signal N
  std::string step = {};  // that failed, and its subcommand: "4 measure"; empty: none of them did
  int attempt = 1;
  bool retry = false;                   // of a failure: to be tried again
  std::string planned;                  // hash of the input that was planned
  std::string input, options, program;  // hashes; input is empty where it could not be read
  FileStamp stamp;                      // of the input as it was read; all 0: not to be trusted
  double seconds = 0, cpu_seconds = 0;
  std::int64_t ended = 0;             // seconds since 1970
  std::string reason;                 // of a failure, one line
  std::string repairs;                // of the mesh: "hole-filled 1; handle-cut 2"; empty: none
  std::vector<std::string> warnings;  // of all steps, each once
  std::vector<BatchFile> files;

  bool failed() const { return outcome == BatchOutcome::Failed; }
};

struct BatchStepRecord {
  BatchStep words;
  int code = 0;
  double seconds = 0;
  std::string report;  // what --json of the step says; empty: nothing
};

struct BatchRecord {
  BatchRecordHead head;
  std::string id, path, plan, host;
  std::int64_t peak_bytes = 0;  // of memory, of the largest step
  std::vector<BatchStepRecord> steps;
  std::string log;  // what the steps said
};

/// As it is written: one object of JSON, what `BatchRecordHead` has first. Of the steps' reports
/// lists of more than 32 entries are left out (coefficients, numbers of vertices).
std::string to_json(const BatchRecord& record);

/// Reads the beginning and no more. Nothing: this is no record, or less than its beginning.
std::optional<BatchRecordHead> read_head(std::string_view json);

/// What is known of an item: the record of its success or of its failure, whichever attempt was
/// later; records with other options, or for another input than is planned, are none, and so are
/// those that are not whole, as a loss of power may leave them.
struct StoredRecord {
  BatchRecordHead head;
  std::string bytes, path;
};
/// Nothing: it is to be run. Throws: ReadError.
std::optional<StoredRecord> record_about(const std::string& folder, const BatchItem& item);

std::string result_folder(const std::string& folder, const std::string& id);
std::string failure_path(const std::string& folder, const std::string& id);

/// Of the repairs of a record: is a surface about the mesh instead of it; was the mesh mended.
bool is_wrapped(const std::string& repairs);
bool is_repaired(const std::string& repairs);

/// "step 4, measure: " before what is said of a failed step of several; empty where there is one
/// step alone, or none of them failed.
std::string words_of_step(const std::string& step, const BatchPlan& plan);

/// A reason as people read it: the input by its name alone.
std::string without_folders(std::string reason, const BatchItem& item);

/// What failed, in a line: the last error in a log, or else what the last step says it found.
std::string reason_in(std::string_view log);

/// What its steps warned of, in their order, each once.
std::vector<std::string> warnings_in(std::string_view log);

/// The bytes of a small file; nothing where there is none. Throws: ReadError.
std::optional<std::string> small_file(const std::string& path);

}  // namespace sphparam
