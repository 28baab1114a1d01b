// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshFileSampler
 * @brief   some points of a file that may be larger than the memory
 *
 * vtkNeuralMeshFileSampler is a source that draws points at random from a binary file. It reads the
 * file once, from front to back, and holds at most a megabyte of it: memory and output depend only
 * on NumberOfPoints. vtkNeuralMesh needs at most 50 points per vertex; its property PointFileName
 * uses this class.
 *
 * @par File
 * - `.ply`, binary, of either byte order: the vertices have x, y and z, all float or all double, and
 *   any other properties but lists. What follows them does not matter; lists must not stand before
 *   them.
 * - `.vtp` whose points are appended raw and not compressed, in one piece: vtkXMLPolyDataWriter with
 *   EncodeAppendedDataOff() and SetCompressorTypeToNone() writes such.
 * - Any file of raw x y z, little-endian, behind HeaderBytes bytes of something else: see Format.
 *
 * It is an error, which names the file, if it does not exist, cannot be read, is of another kind, is
 * damaged, has fewer points than it says, or becomes shorter during reading. A file without points
 * gives an empty output.
 *
 * @par Output
 * vtkPolyData with the points, float or double as in the file and in its order, and without cells.
 * If the file has more than NumberOfPoints points, that number is drawn: one at random from each of
 * as many equal shares of the file, so that all points are equally likely. (A point on the border of
 * two shares may be drawn twice.) Otherwise all points are taken. Points that are not finite are
 * drawn, too: vtkNeuralMesh counts and drops them. Consecutive bytes red, green and blue of a .ply
 * are the point data `RGB`. Its nx, ny and nz of the type of the coordinates are the `Normals`, as
 * in vtkPLYReader. Nothing else of the file is read.
 *
 * The same file and seed give the same bytes. The filter does not notice that the file has changed
 * on the disk: call Modified().
 *
 * @par Abort
 * SetAbortExecute(1), for example from an observer of ProgressEvent, ends the drawing and leaves the
 * output empty. The filter then clears the flag.
 *
 * A property out of its range is clamped, with a warning.
 *
 * @par Limits
 * It does not read text files, compressed files and other formats: read them as a whole, or convert
 * them. See Documentation/Guide/Large.md.
 *
 * @sa vtkNeuralMesh vtkPLYReader vtkXMLPolyDataReader
 */

#ifndef vtkNeuralMeshFileSampler_h
#define vtkNeuralMeshFileSampler_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkNeuralMeshSetClampMacro.h"
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshFileSampler : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshFileSampler* New();
  vtkTypeMacro(vtkNeuralMeshFileSampler, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default none (an empty name, for which null may be given, too), which is an error.
   */
  void SetFileName(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

  /** How points may lie in the file, for SetFormat(). */
  enum FormatType
  {
    BY_EXTENSION,
    RAW_FLOAT,
    RAW_DOUBLE
  };

  ///@{
  /**
   * How the points lie in the file. BY_EXTENSION (default): as the header of the .ply or .vtp says.
   * RAW_FLOAT, RAW_DOUBLE: x y z of 4 or of 8 bytes each, little-endian, up to the end of the file.
   */
  vtkNeuralMeshSetClampMacro(Format, int, BY_EXTENSION, RAW_DOUBLE);
  vtkGetMacro(Format, int);
  void SetFormatToByExtension() { this->SetFormat(BY_EXTENSION); }
  void SetFormatToRawFloat() { this->SetFormat(RAW_FLOAT); }
  void SetFormatToRawDouble() { this->SetFormat(RAW_DOUBLE); }
  ///@}

  ///@{
  /**
   * Where raw points begin, in bytes. Default 0, at least 0.
   */
  vtkNeuralMeshSetClampMacro(HeaderBytes, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(HeaderBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * Number of points drawn from a file that has more. Default 1000000, range 1 to 4294967295.
   */
  vtkNeuralMeshSetClampMacro(NumberOfPoints, vtkIdType, 1, VTK_UNSIGNED_INT_MAX);
  vtkGetMacro(NumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * Seed of the random numbers: which points are drawn. Default 1, at least 0.
   */
  vtkNeuralMeshSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  /**
   * Number of points in the file; known after the execution.
   */
  vtkIdType GetNumberOfFilePoints() const { return this->NumberOfFilePoints; }

  /**
   * CPU seconds of the process that the last execution took.
   */
  double GetDrawingTime() const { return this->DrawingTime; }

protected:
  vtkNeuralMeshFileSampler();
  ~vtkNeuralMeshFileSampler() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshFileSampler(const vtkNeuralMeshFileSampler&) = delete;
  void operator=(const vtkNeuralMeshFileSampler&) = delete;

  std::string FileName;
  int Format = BY_EXTENSION;
  vtkIdType HeaderBytes = 0;
  vtkIdType NumberOfPoints = 1000000;
  int Seed = 1;
  vtkIdType NumberOfFilePoints = 0;
  double DrawingTime = 0.0;
};

#endif
