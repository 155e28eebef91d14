/* What a kernel gets of the scene. */
#include "shared/layout.h"

/* The host says how large it takes the shared structs to be; an array of negative length stops the build. */
typedef char FaceRecordHasTheHostsSize[sizeof(FaceRecord) == FACE_RECORD_BYTES ? 1 : -1];
typedef char ParametersHasTheHostsSize[sizeof(Parameters) == PARAMETERS_BYTES ? 1 : -1];

