# Finds the VTK to build against: ParaView's, if there is a ParaView to develop with, else VTK.
set(NEURALMESH_VTK_COMPONENTS
  CommonCore
  CommonDataModel
  CommonExecutionModel
  CommonMisc
  CommonSystem
  FiltersCore
  FiltersModeling
  FiltersSources
  IOCore
  IOGeometry
  IOLegacy
  IOPLY
  IOXML)

find_package(ParaView 5.10 QUIET COMPONENTS RemotingCore WrapClientServer ProcessXML)
option(NEURALMESH_USE_PARAVIEW "Build against ParaView's VTK" "${ParaView_FOUND}")
if (NEURALMESH_USE_PARAVIEW)
  find_package(ParaView 5.10 REQUIRED COMPONENTS RemotingCore WrapClientServer ProcessXML)
  find_package(VTK REQUIRED COMPONENTS ${NEURALMESH_VTK_COMPONENTS}
    PATHS "${ParaView_DIR}/vtk" NO_DEFAULT_PATH)
else ()
  find_package(VTK 9.1 REQUIRED COMPONENTS ${NEURALMESH_VTK_COMPONENTS})
endif ()
