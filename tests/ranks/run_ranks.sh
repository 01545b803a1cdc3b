#!/bin/sh
# run_ranks.sh MPIRUN RANKS PROGRAM [ARGUMENT...]: as root, too, and with more ranks than cores; each rank's threads may use all.
set -eu
mpirun=$1 ranks=$2
shift 2
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
export OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none
exec "$mpirun" -n "$ranks" "$@"
