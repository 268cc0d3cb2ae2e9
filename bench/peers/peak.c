/* peak COMMAND ARG...: runs a command and prints to standard error its peak resident memory in KiB and its CPU time in ms.
   A process inherits the peak of the one that started it up to its own start, so the starter has to be this small. */
#include <stdio.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    pid_t pid = fork();
    if (pid == 0) {
        execv(argv[1], argv + 1);
        _exit(127);
    }
    int status;
    struct rusage usage;
    if (pid < 0 || wait4(pid, &status, 0, &usage) < 0) return 2;
    double ms = 1e3 * (usage.ru_utime.tv_sec + usage.ru_stime.tv_sec)
              + 1e-3 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    fprintf(stderr, "%ld %f\n", usage.ru_maxrss, ms);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
