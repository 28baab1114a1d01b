#!/usr/bin/env bash
# Includes run one way: Applications -> Filters -> Filters/Core, and between the rooms of the core. Fails
# with the lines that do not.
set -euo pipefail
cd "$1"
# Not every room has templates of headers.
shopt -s nullglob

failed=0
# forbid PATTERN FILE...: no include of the files may match.
forbid()
{
  local pattern=$1
  shift
  [ "$#" -gt 0 ] || { echo "no files to look at"; exit 1; }
  if grep -nE "^ *# *include +[<\"]($pattern)" "$@"; then
    failed=1
  fi
}

forbid 'vtk|pq|paraview' Filters/Core/*/*.{h,h.in,cpp}
# A room knows itself and those before it.
rooms=(base mesh cloud file learn fit start run)
for ((room = 0; room < ${#rooms[@]}; ++room)); do
  later=$(IFS='|'; echo "${rooms[*]:room + 1}")
  files=(Filters/Core/"${rooms[room]}"/*.{h,h.in,cpp})
  forbid "(${later:-nothing})/" "${files[@]}"
  # Whoever reads an include sees the room.
  if grep -nE '^ *# *include +"' "${files[@]}" | grep -vE "\"($(IFS='|'; echo "${rooms[*]}"))/"; then
    failed=1
  fi
done
# Fit and start know nothing of learning: they are given the values that they need.
forbid 'learn/' Filters/Core/{fit,start}/*.{h,h.in,cpp}
if [ "$(find Filters/Core -mindepth 1 -type d | wc -l)" -ne ${#rooms[@]} ] ||
  find Filters/Core -maxdepth 1 -name '*.h' -o -maxdepth 1 -name '*.cpp' | grep .; then
  echo "there is something in Filters/Core that is in no room"
  failed=1
fi
forbid 'vtkPV|vtkSM([^P]|P[^T])|vtkSI|pq|CLI/|ErrorCollector|LearningParameters|MeshWriter|PointReader' \
  Filters/*.h Filters/*.h.in Filters/*.cxx
# The header of a public class is installed; the core is not.
for header in Filters/vtkNeuralMesh.h.in Filters/vtkNeuralMeshAlgorithm.h.in \
  Filters/vtkNeuralMeshEnsemble.h.in Filters/vtkNeuralMeshComparison.h Filters/vtkNeuralMeshExplanation.h \
  Filters/vtkNeuralMeshScan.h Filters/vtkNeuralMeshInformation.h \
  Filters/vtkNeuralMeshFileSampler.h Filters/vtkNeuralMeshStream.h.in \
  Filters/vtkNeuralMeshPLYReader.h Filters/vtkNeuralMeshReader.h Filters/vtkNeuralMeshWriter.h \
  Filters/vtkPNeuralMesh.h Filters/vtkPNeuralMeshEnsemble.h; do
  if grep -nE '^ *# *include +"[^v]' "$header"; then
    failed=1
  fi
done
exit "$failed"
