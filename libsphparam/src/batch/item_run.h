#pragma once

#include <functional>
#include <string>

#include "batch/record.h"
#include "sphparam/batch/run.h"

namespace sphparam {

/// How the process of an item ends. Any other code: it crashed or was killed.
enum ItemEnd : int {
  ItemDone = 0,
  ItemFailed = 10,  // and its record is there
  ItemDoneElsewhere = 11,
  ItemMachineError = 12,
  ItemInterrupted = 13,
};

/// What all items of a run share.
struct ItemSetting {
  const std::string& folder;  // absolute
  const BatchPlan& plan;
  const std::function<int(const BatchStep&, const BatchStepSetting&)>& run_step;
  int threads = 1;  // of a step
};

/// Runs an item from its input to its results, in a process of its own. Throws: BatchMachineError;
/// WriteError.
ItemEnd run_item(const ItemSetting& setting, const BatchItem& item);

/// Records that the process of an item ended in a way it could not record itself, and removes what
/// it left below `staging`. Returns false where its results were out already: whoever is killed
/// after that has done his work, and nothing is recorded. Throws: BatchMachineError; WriteError.
bool record_crash(const ItemSetting& setting, const BatchItem& item, const std::string& staged,
                  int code, double cpu_seconds);

}  // namespace sphparam
