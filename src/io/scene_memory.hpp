// Memory that scene_free releases, taken from C++: malloc behind std::bad_alloc.
#ifndef IO_SCENE_MEMORY_HPP
#define IO_SCENE_MEMORY_HPP

#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

// A copy of count elements; NULL for none.
template <class T> T *scene_array(const T *from, size_t count)
{
    static_assert(std::is_trivially_copyable_v<T>);
    if (count == 0)
        return nullptr;
    if (count > static_cast<size_t>(-1) / sizeof(T))
        throw std::bad_alloc();
    T *memory = static_cast<T *>(std::malloc(count * sizeof(T)));
    if (!memory)
        throw std::bad_alloc();
    std::memcpy(memory, from, count * sizeof(T));
    return memory;
}

template <class T> T *scene_array(const std::vector<T> &from)
{
    return scene_array(from.data(), from.size());
}

inline char *scene_string(const std::string &text)
{
    return scene_array(text.c_str(), text.size() + 1);
}

// Makes room for capacity elements and appends one that is all zero.
template <class T> T *scene_append_within(T **array, int *count, size_t capacity)
{
    static_assert(std::is_trivially_copyable_v<T>);
    T *grown = static_cast<T *>(std::realloc(*array, capacity * sizeof(T)));
    if (!grown)
        throw std::bad_alloc();
    *array = grown;
    T *element = grown + *count;
    std::memset(static_cast<void *>(element), 0, sizeof(T));
    ++*count;
    return element;
}

// A new element, all zero, at the end of an array that was empty and that nothing but this function has made longer:
// there is room up to the next power of two.
template <class T> T *scene_append(T **array, int *count)
{
    const size_t size = static_cast<size_t>(*count);
    if (size == 0 || (size & (size - 1)) == 0)
        return scene_append_within(array, count, size == 0 ? 1 : 2 * size);
    T *element = *array + size;
    std::memset(static_cast<void *>(element), 0, sizeof(T));
    ++*count;
    return element;
}

// The same for an array of any origin.
template <class T> T *scene_append_to_any(T **array, int *count)
{
    return scene_append_within(array, count, static_cast<size_t>(*count) + 1);
}

#endif
