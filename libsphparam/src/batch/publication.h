#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/record.h"

namespace sphparam {

/// Gives a folder of results its name, in one step. False: another run did so for the same item
/// before; then nothing happened. What is there of another plan is replaced, and is where the
/// results were. A failure of the item is forgotten. Throws: BatchMachineError.
bool publish_results(const std::string& folder, const std::string& staged, const BatchItem& item);

/// The record of a failure, in one step. Throws: BatchMachineError; WriteError.
void publish_failure(const std::string& folder, const std::string& staged,
                     const BatchRecord& record);

/// The same from the record's bytes.
void publish_failure_bytes(const std::string& folder, const std::string& staged,
                           const std::string& id, std::string bytes);

/// Is the latest that is known of an item a result of this program, with its files?
bool has_results(const std::string& folder, const BatchItem& item);

/// Are the files of a result there, with their sizes?
bool has_its_files(const std::string& folder, const std::vector<BatchFile>& files);

/// All files below a folder, by name. Throws: ReadError.
std::vector<BatchFile> files_below(const std::string& folder);

/// Why a step failed, in a line: the last error that it told, or the signal that ended it.
std::string reason_of_end(int code, std::string_view log);

}  // namespace sphparam
