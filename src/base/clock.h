/* The time, for measuring how long something takes. */
#ifndef RECTRAY_CLOCK_H
#define RECTRAY_CLOCK_H

/* Milliseconds since some fixed moment; never goes back, whatever is done to the system's clock. */
double clock_ms(void);

#endif
