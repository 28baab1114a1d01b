// SPDX-License-Identifier: BSD-3-Clause
#ifndef WholeFile_h
#define WholeFile_h

#include <functional>
#include <string>

/**
 * Throws std::runtime_error, with a message that names the file, where it can be told beforehand
 * that WriteWholeFile() would fail: there is no such folder, it takes no files, or `path` is a
 * folder.
 */
void RequireWritablePlace(const std::string& path);

/**
 * Has `write` write a file under another name beside `path`, with the extension in small letters,
 * and renames it: nobody ever sees half of it, and if writing fails, what was there before stays.
 * The other name is hidden, and made of that of the file, of the machine and of the process. A
 * process that is killed while it writes leaves it behind; the next one that writes the same file on
 * the same machine removes it.
 * Throws std::runtime_error, with a message that names the file, where `write` throws or the
 * renaming fails.
 */
void WriteWholeFile(
  const std::string& path, const std::function<void(const std::string& temporary)>& write);

/** Writes `text` to a file. Throws std::runtime_error if not all of it could be written. */
void WriteText(const std::string& text, const std::string& path);

#endif
