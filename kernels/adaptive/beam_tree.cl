/* The search of a tree by a beam: BEAM_TREE, a build option, is one of the files beam_*.cl of this folder. */
#include BEAM_TREE
