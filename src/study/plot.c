/* Figures by gnuplot, a program of its own, which reads a script from a pipe and runs in the folder of the tables. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "study/study.h"

/* style.gnuplot, made into text by the build: how every figure looks. */
extern const unsigned char style_gnuplot[];

/* Never comes back. in, out: descriptors for standard input and output, -1: none. */
static void become_gnuplot(const char *folder, int in, const char *argument)
{
    const int nowhere = open("/dev/null", O_RDWR);
    if (dup2(in >= 0 ? in : nowhere, STDIN_FILENO) < 0 || dup2(nowhere, STDOUT_FILENO) < 0 || chdir(folder) != 0)
        _exit(126);
    /* Ctrl-C is for the command, which waits for the figure; a closed pipe ends gnuplot as it ends any program. */
    signal(SIGINT, SIG_IGN);
    signal(SIGPIPE, SIG_DFL);
    execlp("gnuplot", "gnuplot", argument, (char *)NULL);
    _exit(127);
}

/* Its exit code, or -1. */
static int wait_for(pid_t child)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool study_can_plot(void)
{
    const pid_t child = fork();
    if (child == 0)
        become_gnuplot("/", -1, "--version");
    return child > 0 && wait_for(child) == 0;
}

static bool write_all(int to, const char *text)
{
    for (size_t left = strlen(text); left > 0;) {
        const ssize_t written = write(to, text, left);
        if (written < 0 && errno != EINTR)
            return false;
        const size_t some = written > 0 ? (size_t)written : 0;
        text += some;
        left -= some;
    }
    return true;
}

/* gnuplot's exit code, or -1. */
static int run_script(const char *folder, const char *const parts[], int count)
{
    int ends[2];
    if (pipe(ends) != 0)
        return -1;
    /* Or gnuplot would hold the writing end itself and wait for its script to end. */
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    const pid_t child = fork();
    if (child == 0)
        become_gnuplot(folder, ends[0], "-");
    close(ends[0]);
    /* A gnuplot that gives up early leaves a pipe without a reader. */
    struct sigaction ignore = { .sa_handler = SIG_IGN }, old;
    sigaction(SIGPIPE, &ignore, &old);
    bool written = child > 0;
    for (int i = 0; i < count && written; ++i)
        written = write_all(ends[1], parts[i]);
    close(ends[1]);
    sigaction(SIGPIPE, &old, NULL);
    const int code = child > 0 ? wait_for(child) : -1;
    return written || code > 0 ? code : -1;
}

/* gnuplot does not look whether the disk took what it wrote, but it closes every picture with these words. */
static bool is_whole(const char *path, const char *ending)
{
    const char *const last = strcmp(ending, "png") == 0 ? "IEND" : "</svg>";
    const size_t length = strlen(last);
    char tail[32];
    size_t size = 0;
    FILE *const f = fopen(path, "rb");
    if (f != NULL && fseek(f, -(long)sizeof tail, SEEK_END) == 0)
        size = fread(tail, 1, sizeof tail, f);
    if (f != NULL)
        fclose(f);
    for (size_t i = 0; i + length <= size; ++i)
        if (memcmp(tail + i, last, length) == 0)
            return true;
    return false;
}

/* Written beside and renamed: an interrupted run leaves no half a picture. */
static bool draw(const char *folder, const study_figure *figure, const char *ending, const char *terminal, report *r)
{
    char opening[512], part[4096], whole[4096];
    const int length = snprintf(part, sizeof part, "%s/%s.%s.part", folder, figure->name, ending);
    if (length < 0 || (size_t)length >= sizeof part)
        return report_error(r, "%s: the name of the folder is too long for figures", folder);
    snprintf(whole, sizeof whole, "%s/%s.%s", folder, figure->name, ending);
    snprintf(opening, sizeof opening, "set terminal %s\nset output '%s.%s.part'\n", terminal, figure->name, ending);
    const char *const script[] = { opening, (const char *)style_gnuplot, "\n", (const char *)figure->script,
                                   "\nset output\n" };
    const int code = run_script(folder, script, sizeof script / sizeof script[0]);
    const bool drawn = code == 0 && is_whole(part, ending);
    if (drawn && rename(part, whole) == 0)
        return true;
    const int reason = errno;
    unlink(part);
    if (drawn)
        return report_error(r, "%s: cannot be written: %s", whole, strerror(reason));
    if (code == 0)
        return report_error(r, "%s: gnuplot could not write all of it", whole);
    return report_error(r, "%s: gnuplot could not draw it (exit code %d)", whole, code);
}

bool study_plot(const char *folder, const study_figure *figure, report *r)
{
    return draw(folder, figure, "png", "pngcairo size 900,560 font 'DejaVu Sans,11'", r) &&
           draw(folder, figure, "svg", "svg size 900,560 font 'DejaVu Sans, Arial, sans-serif,11' background 'white'",
                r);
}
