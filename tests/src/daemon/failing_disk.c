/* A disk that fails, for tests: answers `read` in place of the C library for files whose path contains
 * FAILING_DISK_PART. In the folder FAILING_DISK
 *   hold     while it is there, a read hangs, and `holding` is made to say so;
 *   fail     one read fails with FAILING_DISK_ERRNO for each byte of it, which it takes away;
 *   failed   gets a line for each read that failed: milliseconds of the monotonic clock. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;

static void at(char *path, const char *name)
{
    snprintf(path, 4096, "%s/%s", getenv("FAILING_DISK"), name);
}

static int is_meant(int fd)
{
    char link[64], path[4096];
    const char *part = getenv("FAILING_DISK_PART");
    if (part == NULL || fd < 3)
        return 0;
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0)
        return 0;
    path[length] = 0;
    return strstr(path, part) != NULL;
}

static void hang(void)
{
    char hold[4096], holding[4096];
    at(hold, "hold");
    at(holding, "holding");
    while (access(hold, F_OK) == 0) {
        close(open(holding, O_CREAT | O_WRONLY, 0666));
        usleep(5000);
    }
}

static int fails(void)
{
    char path[4096];
    struct stat is;
    struct timespec now;
    at(path, "fail");
    if (stat(path, &is) != 0 || is.st_size == 0 || truncate(path, is.st_size - 1) != 0)
        return 0;
    clock_gettime(CLOCK_MONOTONIC, &now);
    at(path, "failed");
    FILE *failed = fopen(path, "a");
    if (failed != NULL) {
        fprintf(failed, "%lld\n", (long long)now.tv_sec * 1000 + now.tv_nsec / 1000000);
        fclose(failed);
    }
    return 1;
}

ssize_t read(int fd, void *buffer, size_t count)
{
    static ssize_t (*next)(int, void *, size_t);
    if (next == NULL)
        next = (ssize_t (*)(int, void *, size_t))dlsym(RTLD_NEXT, "read");
    int was = errno;
    if (is_meant(fd)) {
        hang();
        pthread_mutex_lock(&one_at_a_time);
        int failed = fails();
        pthread_mutex_unlock(&one_at_a_time);
        if (failed) {
            errno = atoi(getenv("FAILING_DISK_ERRNO"));
            return -1;
        }
    }
    errno = was;
    return next(fd, buffer, count);
}
