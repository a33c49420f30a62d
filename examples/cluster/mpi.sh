#!/bin/sh
# A study or a calibration on the ranks of one MPI job: one rank per node with all its cores; rank 0 reads and writes all files.
# Needs a program built with -DPHY_MPI=ON. Submitted again it goes on where it was (a calibration with --resume).
#   sbatch examples/cluster/mpi.sh study examples/paper/study.toml --out results/paper
#   sbatch examples/cluster/mpi.sh calibrate rock.toml --out results/rock --resume
#SBATCH --job-name=phyllite
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=1
#SBATCH --cpus-per-task=16
#SBATCH --time=02:00:00
exec mpirun --map-by node:PE="$SLURM_CPUS_PER_TASK" phyllite --threads "$SLURM_CPUS_PER_TASK" "$@" --mpi
