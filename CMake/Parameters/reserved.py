# SPDX-License-Identifier: BSD-3-Clause
"""Names that a parameter or a value cannot have, as C++ or VTK has them already."""

CPP = frozenset(
    """alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t
    char32_t class compl concept const consteval constexpr constinit const_cast continue co_await
    co_return co_yield decltype default delete do double dynamic_cast else enum explicit export extern
    false float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr
    operator or or_eq private protected public register reinterpret_cast requires return short signed
    sizeof static static_assert static_cast struct switch template this thread_local throw true try
    typedef typeid typename union unsigned using virtual void volatile wchar_t while xor xor_eq"""
    .split()
)

# Properties of vtkObject, vtkAlgorithm and vtkPolyDataAlgorithm.
VTK = frozenset(
    """AbortExecute AbortExecuteAndUpdateTime AbortOutput ArrayName ClassName Command ContainerAlgorithm
    Debug ErrorCode Executive GlobalWarningDisplay Information Input InputAlgorithm
    InputArrayAssociation InputArrayFieldAssociation InputArrayInformation InputArrayToProcess
    InputConnection InputConnectionInformation InputData InputDataObject InputExecutive
    InputInformation InputPortInformation IsInMemkind LastAbortCheckTime LastAbortTime MTime
    MemkindDirectory NoPriorTemporalAccessInformationKey NumberOfGenerationsFromBase
    NumberOfInputConnections NumberOfInputPorts NumberOfOutputPorts ObjectDescription ObjectName
    Output OutputData OutputDataObject OutputInformation OutputPort OutputPortInformation Progress
    ProgressObserver ProgressScale ProgressShift ProgressShiftScale ProgressText ReferenceCount
    ReleaseDataFlag TotalNumberOfInputConnections UpdateExtent UpdateGhostLevel UpdateNumberOfPieces
    UpdatePiece UsingMemkind UpdateTimeStep""".split()
)

# Macros of the C and C++ libraries that look like constants of VTK.
MACROS = frozenset(
    """ASSERT DEBUG DOMAIN EOF ERROR FALSE HUGE_VAL IN INFINITY NAN NDEBUG NULL OUT OVERFLOW PLOSS SING
    STDERR STDIN STDOUT TLOSS TRUE UNDERFLOW""".split()
)
