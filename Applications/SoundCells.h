// SPDX-License-Identifier: BSD-3-Clause
#ifndef SoundCells_h
#define SoundCells_h

class vtkPointSet;

/**
 * Whether all cells have the corners that their kind needs, which are among the points. VTK's
 * readers do not look after that, and its filters rely on it.
 */
bool HasSoundCells(vtkPointSet* data);

#endif
