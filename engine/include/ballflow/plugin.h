/* The boundary between the engine and node libraries: plain C, versioned, no exception, no C++ type.
 *
 * A node library is a shared object that exports
 *
 *     const bf_plugin* ballflow_plugin(void);
 *
 * and carries, in an ELF section named ".ballflow.abi", one bf_abi_note. The engine reads that section
 * from the file before it loads the library: a library built for another ABI is refused and none of its
 * code, static initialisers included, ever runs. BALLFLOW_PLUGIN in <ballflow/sdk.hpp> provides both.
 *
 * Declarations cross the boundary as JSON text (what is in it: node_decl.hpp; sdk.hpp writes it).
 * Every struct starts with its size, so that members can be appended within one ABI version. */
#ifndef BALLFLOW_PLUGIN_H
#define BALLFLOW_PLUGIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BALLFLOW_ABI_VERSION 1u
#define BALLFLOW_ABI_MAGIC "BALLFLOW" /* 8 bytes, no terminator */
#define BALLFLOW_ABI_SECTION ".ballflow.abi"
#define BALLFLOW_MAX_RANK 4u

typedef struct bf_abi_note {
  char magic[8];
  uint32_t abi_version;
  uint32_t reserved; /* 0 */
} bf_abi_note;

/* A piece of UTF-8 text or bytes; not terminated. */
typedef struct bf_bytes {
  const char* data;
  uint64_t size;
} bf_bytes;

typedef enum bf_dtype {
  BF_F64 = 1,
  BF_F32 = 2,
  BF_I64 = 3,
  BF_I32 = 4,
  BF_U32 = 5,
  BF_U16 = 6,
  BF_U8 = 7
} bf_dtype;

/* One named array, C order. */
typedef struct bf_array {
  bf_bytes name;
  uint32_t dtype; /* bf_dtype */
  uint32_t rank;  /* 0 (one number) to BALLFLOW_MAX_RANK */
  uint64_t shape[BALLFLOW_MAX_RANK];
  const void* data;
  /* Outputs only: the receiver calls release(owner) once when it no longer needs `data`. */
  void* owner;
  void (*release)(void* owner);
} bf_array;

/* An artifact handed to a node. `data` of its arrays stays valid until the last release. */
typedef struct bf_artifact {
  const bf_array* arrays;
  uint64_t array_count;
  void* owner;
  void (*retain)(void* owner);
  void (*release)(void* owner);
} bf_artifact;

typedef enum bf_level { BF_INFO = 0, BF_WARNING = 1 } bf_level;

/* What the engine offers to a running node. Every function may be called from any thread. */
typedef struct bf_run {
  uint32_t struct_size;
  uint32_t max_threads;
  uint64_t seed;
  bf_bytes params; /* canonical JSON object with every declared parameter */
  void* self;
  int (*cancelled)(void* self);
  void (*progress)(void* self, double fraction);
  void (*log)(void* self, uint32_t level, bf_bytes text);
  /* Returns 0 and leaves *artifact untouched when the port is optional and not connected.
   * The artifact is borrowed for the duration of the run; retain it to keep its data longer. */
  int (*input)(void* self, bf_bytes port, bf_artifact* artifact);
  /* Hands over the arrays of an output port (ownership of every array passes to the engine, also on
   * failure) and its summary, a JSON object. Returns 0 on success. */
  int (*output)(void* self, bf_bytes port, const bf_array* arrays, uint64_t array_count, bf_bytes summary);
  /* Why the node failed: one line with the cause, one line with what to do next (may be empty). */
  void (*fail)(void* self, bf_bytes cause, bf_bytes hint);
} bf_run;

typedef enum bf_status { BF_OK = 0, BF_FAILED = 1, BF_CANCELLED = 2 } bf_status;

typedef struct bf_node {
  uint32_t struct_size;
  uint32_t reserved;
  bf_bytes declaration;          /* JSON, see node_decl.hpp */
  int (*run)(const bf_run* run); /* bf_status; stateless, may run in several threads at once */
} bf_node;

typedef struct bf_type {
  uint32_t struct_size;
  uint32_t reserved;
  bf_bytes declaration; /* JSON, see node_decl.hpp */
  /* Calls found(context, text) when an invariant of the type is broken. */
  void (*check)(const bf_artifact* artifact, void* context, void (*found)(void* context, bf_bytes text));
} bf_type;

typedef struct bf_plugin {
  uint32_t struct_size;
  uint32_t abi_version;
  bf_bytes name;
  bf_bytes version;
  const bf_type* const* types;
  uint64_t type_count;
  const bf_node* const* nodes;
  uint64_t node_count;
} bf_plugin;

typedef const bf_plugin* (*bf_plugin_entry)(void);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif
