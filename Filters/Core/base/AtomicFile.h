// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace neuralmesh
{
/// Throws std::runtime_error, with a message that names the file, where it can be told beforehand
/// that writeAtomicFile() would fail: there is no such folder, it takes no files, or `path` is a
/// folder.
void requireWritablePlace(const std::string& path);

/// Has `write` write a file under another name beside `path`, with the extension in small letters,
/// and renames it once it is on the disk: nobody ever sees half of it, even if the process is killed
/// or the power fails, and if writing fails, what was there before stays. The other name is hidden, and
/// made of that of the file, of the machine and of the process. A process that is killed while it
/// writes leaves it behind; the next one that writes the same file on the same machine removes it.
/// Throws std::runtime_error, with a message that names the file, where `write` throws or the renaming
/// fails.
void writeAtomicFile(
  const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// Writes `text` to a file. Throws std::runtime_error if not all of it could be written.
void writeText(const std::string& text, const std::string& path);

/// Removes a file, if it is there, and what processes that were killed while they wrote it have left
/// beside it.
void removeAtomicFile(const std::string& path);
}
