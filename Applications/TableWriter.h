// SPDX-License-Identifier: BSD-3-Clause
#ifndef TableWriter_h
#define TableWriter_h

#include <string>

class vtkTable;

/** Throws std::runtime_error if WriteTable() would not know the extension: to be asked early. */
void RequireTableExtension(const std::string& path);

/**
 * Writes a table as .csv, with a line of column names. Whole or not at all, as
 * neuralmesh::writeAtomicFile().
 * Throws std::runtime_error, with a message that names the file, on failure.
 */
void WriteTable(vtkTable* table, const std::string& path);

#endif
