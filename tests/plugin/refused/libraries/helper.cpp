// What a node library of somebody else may use.
extern "C" int helper_version() { return 1; }
