// SPDX-License-Identifier: BSD-3-Clause
#ifndef VTKThreads_h
#define VTKThreads_h

/** Has VTK use so many threads from now on. */
void SetNumberOfVTKThreads(int count);

#endif
