/// Jumps where there are none: WebAssembly. The one that leaves GLPK stops the module instead, and
/// whoever called it starts another instance.
#ifndef SIGHTLINE_ALONE_SETJMP_H
#define SIGHTLINE_ALONE_SETJMP_H

typedef int jmp_buf[1];
#define setjmp(buffer)         ((void)(buffer), 0)
#define longjmp(buffer, value) ((void)(buffer), (void)(value), __builtin_trap())

#endif
