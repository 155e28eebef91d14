/* What happens when the user or the system stops the program half-way: no half-written file stays behind.
 * The one place with state that outlives a call, for a signal's handler sees nothing else. */
#ifndef RECTRAY_INTERRUPT_H
#define RECTRAY_INTERRUPT_H

/* From now on SIGINT, SIGTERM and SIGHUP remove the guarded file, say so on stderr
 * and end the program with status 128 + signal. A standard output whose reader is gone ends it too, without a word, by
 * SIGPIPE. A write to another closed pipe, or beyond the largest file allowed, fails with an errno instead. */
void interrupt_install(void);

/* Creates a new file (never opens one that exists) and guards it: no signal comes between the two. The path must live
 * until interrupt_release. Returns the descriptor, or -1 with errno set. One file at a time. */
int interrupt_create_guarded(const char *path);

/* The guarded file has its final name, or is gone. */
void interrupt_release(void);

#endif
