# SPDX-License-Identifier: GPL-3.0-or-later
# REGULUS_MPI: build regulus-mpi, for searches by many processes. Without a choice: if MPI is there.
if(NOT DEFINED REGULUS_MPI)
  find_package(MPI QUIET COMPONENTS C)
elseif(REGULUS_MPI)
  find_package(MPI REQUIRED COMPONENTS C)
endif()
option(REGULUS_MPI "Build regulus-mpi, for searches by many processes" ${MPI_C_FOUND})
if(REGULUS_MPI)
  message(STATUS "Cluster: MPI ${MPI_C_VERSION}")
endif()
