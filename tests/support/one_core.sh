# one_core.sh: sourced by what counts a program's instructions. Keeps the script, and what it starts, on one processor: Embree then has no
# workers, whose waiting for work counts too, millions of instructions more or fewer with what else the machine does.
taskset -cp "$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//')" $$ >/dev/null
