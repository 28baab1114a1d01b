#!/usr/bin/env bash
# Includes run one way: Applications -> Filters -> Filters/Core. Fails with the lines that do not.
set -euo pipefail
cd "$1"

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

forbid 'vtk|pq|paraview' Filters/Core/*.h Filters/Core/*.cpp
forbid 'vtkPV|vtkSM([^P]|P[^T])|vtkSI|pq|CLI/|ErrorCollector|LearningParameters|MeshWriter|PointReader' \
  Filters/*.h Filters/*.cxx
# The header of a public class is installed; the core is not.
for header in Filters/vtkNeuralMesh.h Filters/vtkNeuralMeshAlgorithm.h \
  Filters/vtkNeuralMeshEnsemble.h Filters/vtkNeuralMeshComparison.h Filters/vtkNeuralMeshScan.h Filters/vtkNeuralMeshFileSampler.h Filters/vtkNeuralMeshStream.h \
  Filters/vtkPNeuralMesh.h Filters/vtkPNeuralMeshEnsemble.h; do
  if grep -nE '^ *# *include +"[^v]' "$header"; then
    failed=1
  fi
done
exit "$failed"
