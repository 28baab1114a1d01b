// SPDX-License-Identifier: BSD-3-Clause
#ifndef SoundCells_h
#define SoundCells_h

class vtkPointSet;

/**
 * Whether all cells refer to points that exist. VTK's readers do not look after that, and its
 * filters rely on it.
 */
bool HasSoundCells(vtkPointSet* data);

#endif
