/// What the command needs of the operating system: system_posix.c, and system_windows.c in its
/// place there. Paths are UTF-8.
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// To be called before anything else. Standard streams that are closed are held, so that no file
/// takes their place; writes to a pipe whose reader is gone fail. Where arguments are no UTF-8 they
/// are replaced by theirs.
void system_begin(int *argc, char ***argv);

/// Whether a stream is a terminal.
bool system_is_terminal(FILE *stream);
/// The width of the terminal of stderr in characters; 0 where it is not known.
int system_terminal_width(void);
/// Whether what reads stdout has gone away.
bool system_reader_is_gone(void);

/// Calls `handler` on an interruption: Ctrl-C, or the wish of the system that the program ends. One
/// that is ignored from the start (nohup) stays ignored. NULL: interruptions end the program again.
void system_on_interruption(void (*handler)(int number));

/// Whether two paths are one plain file, maybe through links. NULL is stdin or stdout, as said by
/// the stream's number, 0 or 1.
bool system_is_one_file(const char *a, int a_stream, const char *b, int b_stream);
/// The size of a file in bytes; 0 where there is none.
uint64_t system_file_size(const char *path);
/// Whether the path itself is a link.
bool system_is_link(const char *path);
/// Makes a folder of its own name: `path` ends in six X, which it replaces.
bool system_make_folder(char *path);
/// Renames a file or a folder; a file takes the place and the permissions of an older one.
bool system_move(const char *from, const char *to);
void system_remove_file(const char *path);
void system_remove_folder(const char *path);

/// A file without a name, to write and read; it goes when it is closed. NULL: errno says why.
FILE *system_open_scratch(void);
/// Runs this program with other words, of which words[0] is its own path or name and the last is
/// NULL. `out` and `err` take what it writes; it reads nothing. `stops` is asked now and then:
/// when it is true, the process is ended. Waits for the end and gives the exit status, 128 and the
/// number of a signal that ended it. False where it cannot be started; errno says why.
bool system_run(char *const *words, FILE *out, FILE *err, bool (*stops)(void *user), void *user,
                int *exit_status);

/// The most memory that the program has had, in bytes; 0 where it is not known.
uint64_t system_peak_memory(void);

#endif
