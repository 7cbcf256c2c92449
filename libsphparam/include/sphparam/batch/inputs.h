#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sphparam {

/// Inputs that cannot be planned: nothing there, a file that is missing, two shapes of one id. Says
/// which, and what to do.
class BatchInputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A shape of a batch.
struct BatchInput {
  std::string id;    // letters, digits, '.', '_' and '-', up to 100 bytes; its folder of results
  std::string path;  // absolute
  std::vector<std::string> values = {};  // one a column of `BatchInputs`
};

struct BatchInputs {
  std::vector<std::string> columns = {};  // of tables, beside path and id
  std::vector<BatchInput> shapes = {};    // in the order of the places, folders sorted by name
  std::vector<std::string> notes = {};    // what was left out of folders, a line a reason
};

struct BatchInputOptions {
  /// Which surface of a subject, in BIDS and FreeSurfer folders: "white", "pial", "midthickness".
  std::string surface = "white";
};

/// What a batch is made of. A place is
/// - a mesh, a shape model of a body (ICQ, plate table) also as .txt;
/// - a pattern with *, ? or [ in it, as shells know them;
/// - a table, .csv or .tsv, with a header: the column `path`, an `id` where wanted, and columns
///   whose values stand for {NAME} in the options of the batch;
/// - a list, any other file of text or "-": a path a line, '#' begins a remark;
/// - a folder: subjects of FreeSurfer (SUBJECT/surf/lh.white, rh.white; also as .gii), a BIDS data
///   set (dataset_description.json; sub-*/**/*_white.surf.gii), else all meshes in it and below,
///   but for hidden ones, those that cannot be read, and the results of batches that lie in it.
/// Paths in lists and tables are relative to the file they stand in, or else to the current folder.
/// An id is the table's, or else the name of the file without its endings, with the names of its
/// folders before it where two have one name, '_' for what is no letter or digit, and a hash where
/// two would be alike or one is too long. A folder that several links lead to is looked into once.
/// Ensures: at least one shape, all files are there, ids are distinct. Throws: BatchInputError;
/// ReadError for a list that cannot be read. Cost: a look at each file.
BatchInputs find_batch_inputs(const std::vector<std::string>& places,
                              const BatchInputOptions& options = {});

}  // namespace sphparam
