// The public header needs nothing before it, and says what the library is.
#include <deliso/deliso.h>

static_assert(DELISO_VERSION == DELISO_VERSION_MAJOR * 10000 + DELISO_VERSION_MINOR * 100 + DELISO_VERSION_PATCH);

int main() { return deliso::version() == DELISO_VERSION_TEXT ? 0 : 1; }
