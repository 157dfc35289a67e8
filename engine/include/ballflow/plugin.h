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
 * Declarations cross the boundary as JSON text (what is in it: node_decl.hpp; the SDK writes it).
 *
 * Growing within one ABI version: every struct but bf_bytes and bf_abi_note starts with its size as the
 * side that made it knows it. Members are only ever appended; a struct of at least its ..._MIN_SIZE is
 * accepted, and a member beyond struct_size is not there. An array of structs is walked in steps of the
 * struct_size of its first one. Members named `reserved` are 0.
 *
 * No function of either side may throw or jump through the other: what goes wrong is said by a return value
 * or by bf_run.fail. */
#ifndef BALLFLOW_PLUGIN_H
#define BALLFLOW_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BALLFLOW_ABI_VERSION 2u
#define BALLFLOW_ABI_MAGIC "BALLFLOW" /* 8 bytes, no terminator */
#define BALLFLOW_ABI_SECTION ".ballflow.abi"
#define BALLFLOW_MAX_RANK 4u

/* The bytes of a struct up to and including a member. */
#define BALLFLOW_SIZE_UP_TO(type, member) (offsetof(type, member) + sizeof(((type*)0)->member))

typedef struct bf_abi_note {
  char magic[8];
  uint32_t abi_version;
  uint32_t reserved;
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
  uint32_t struct_size;
  uint32_t dtype; /* bf_dtype */
  bf_bytes name;
  uint32_t rank; /* 0 (one number) to BALLFLOW_MAX_RANK */
  uint32_t reserved;
  uint64_t shape[BALLFLOW_MAX_RANK];
  const void* data; /* aligned to its element; may be null when there is no element */
  /* Outputs only: the receiver calls release(owner) once when it no longer needs `data`. May be null. */
  void* owner;
  void (*release)(void* owner);
} bf_array;
#define BF_ARRAY_MIN_SIZE BALLFLOW_SIZE_UP_TO(bf_array, release)

/* An artifact handed to a node. Everything that it points to stays valid until the last release. */
typedef struct bf_artifact {
  uint32_t struct_size;
  uint32_t type_version;
  bf_bytes type;    /* id of its type */
  bf_bytes summary; /* canonical JSON object */
  const bf_array* arrays;
  uint64_t array_count;
  void* owner;
  void (*retain)(void* owner);
  void (*release)(void* owner);
} bf_artifact;
#define BF_ARTIFACT_MIN_SIZE BALLFLOW_SIZE_UP_TO(bf_artifact, release)

typedef enum bf_level { BF_INFO = 0, BF_WARNING = 1 } bf_level;

/* What the engine offers to a running node. Every function may be called from any thread while the node
 * runs; its first argument is `host`. */
typedef struct bf_run {
  uint32_t struct_size;
  uint32_t max_threads;
  uint64_t seed;
  bf_bytes node; /* id of the node, as declared: one function may serve many. Its name in a graph is not told,
                    because results must not depend on it. */
  bf_bytes params; /* canonical JSON object with every declared parameter */
  void* host;
  /* Not 0 once the run should end: stop soon and return BF_CANCELLED. */
  int (*cancelled)(void* host);
  void (*progress)(void* host, double fraction);
  void (*log)(void* host, uint32_t level, bf_bytes text);
  /* How many artifacts are connected to an input: 0 or 1, and any number for a port that is a list. */
  uint64_t (*input_count)(void* host, bf_bytes port);
  /* Fills *artifact, whose struct_size the caller has set, with artifact `index` of an input, in the order of
   * the graph. Returns 0 and leaves it untouched when there is none. The artifact is borrowed for the
   * duration of the run; retain it to keep its data longer. */
  int (*input)(void* host, bf_bytes port, uint64_t index, bf_artifact* artifact);
  /* Hands over the arrays of an output port (ownership of every array passes to the engine, also on
   * failure) and its summary, a JSON object. No bytes: the summary that the type makes of the arrays, and {}
   * where it makes none. Returns 0 on success. */
  int (*output)(void* host, bf_bytes port, const bf_array* arrays, uint64_t array_count, bf_bytes summary);
  /* Why the node failed: one line with the cause, one line with what to do next (may be empty). */
  void (*fail)(void* host, bf_bytes cause, bf_bytes hint);
  /* Bytes that all nodes of the run may take together; 0 when nobody has said. A node that learns it will
   * need more should fail and say so before it takes them. Only that may depend on it: results must not. */
  uint64_t memory_bytes;
} bf_run;
#define BF_RUN_MIN_SIZE BALLFLOW_SIZE_UP_TO(bf_run, fail)

typedef enum bf_status { BF_OK = 0, BF_FAILED = 1, BF_CANCELLED = 2 } bf_status;

typedef struct bf_node {
  uint32_t struct_size;
  uint32_t reserved;
  bf_bytes declaration; /* JSON, see node_decl.hpp */
  void* self;           /* first argument of run: an object of another language, or null */
  /* Returns a bf_status. Keeps nothing from run to run, may run in several threads at once. */
  int (*run)(void* self, const bf_run* run);
  /* May be null. Which files the node will read besides those that its parameters name, because those name
   * them: calls found(context, name, path) for each, with the name as it is written there, and an empty path
   * where there is no such file. `params` is as in bf_run. What it finds enters the key by content. It is
   * called for every plan, so it must be quick, and finds nothing where the node would fail. */
  void (*files)(void* self, bf_bytes params, void* context,
                void (*found)(void* context, bf_bytes name, bf_bytes path));
} bf_node;
#define BF_NODE_MIN_SIZE BALLFLOW_SIZE_UP_TO(bf_node, run)

typedef struct bf_type {
  uint32_t struct_size;
  uint32_t reserved;
  bf_bytes declaration; /* JSON, see node_decl.hpp */
  void* self;           /* first argument of check */
  /* Calls found(context, text) when an invariant of the type is broken. May be null. The engine has compared
   * the arrays with the declaration before. */
  void (*check)(void* self, const bf_artifact* artifact, void* context,
                void (*found)(void* context, bf_bytes text));
  /* May be null. Calls made(context, summary) with the summary of an artifact that `check` found nothing
   * wrong with: for who has the arrays alone, like nodes and programs of other languages. Whoever calls it
   * ignores the summary that the artifact has. */
  void (*summarize)(void* self, const bf_artifact* artifact, void* context,
                    void (*made)(void* context, bf_bytes summary));
} bf_type;
#define BF_TYPE_MIN_SIZE BALLFLOW_SIZE_UP_TO(bf_type, check)

typedef struct bf_plugin {
  uint32_t struct_size;
  uint32_t abi_version;
  bf_bytes name;
  bf_bytes version;
  const bf_type* const* types;
  uint64_t type_count;
  const bf_node* const* nodes;
  uint64_t node_count;
  /* Called once when the engine needs these tables and what they point to no more; null where they live as
   * long as the process, like those of a shared object, which is never unloaded. */
  void* owner;
  void (*release)(void* owner);
} bf_plugin;
#define BF_PLUGIN_MIN_SIZE BALLFLOW_SIZE_UP_TO(bf_plugin, release)

typedef const bf_plugin* (*bf_plugin_entry)(void);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif
