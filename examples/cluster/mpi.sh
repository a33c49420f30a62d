#!/bin/sh
# A study on the ranks of one MPI job: one rank per node with all its cores, one store, written by rank 0 alone. Needs a
# program built with -DPHY_MPI=ON. Submitted again it goes on where it was.
#   sbatch examples/cluster/mpi.sh examples/paper/study.toml results/paper
#SBATCH --job-name=phyllite
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=1
#SBATCH --cpus-per-task=16
#SBATCH --time=02:00:00
exec mpirun --map-by node:PE="$SLURM_CPUS_PER_TASK" phyllite --threads "$SLURM_CPUS_PER_TASK" study "$1" --out "$2" --mpi
