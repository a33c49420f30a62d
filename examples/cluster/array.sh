#!/bin/sh
# A study as a job array for Slurm, eight parts of four threads; other queues: set the number of the part by hand.
#   sbatch examples/cluster/array.sh examples/paper/study.toml results/paper
# A part that was cancelled or ran out of time goes on where it was when the file is submitted again. When all parts are
# done: phyllite study merge results/paper. `phyllite study STUDY --slurm N` prints such a file for N parts.
#SBATCH --job-name=phyllite
#SBATCH --array=1-8
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --time=02:00:00
exec phyllite --threads "$SLURM_CPUS_PER_TASK" study "$1" --out "$2" --shard "$SLURM_ARRAY_TASK_ID/8"
