// What is wrong with a file and where: thrown by the readers, caught where C calls them.
#ifndef IO_FILE_ERROR_HPP
#define IO_FILE_ERROR_HPP

#include <exception>
#include <string>
#include <utility>

struct file_error : std::exception {
    std::string place; // a JSON pointer or "byte 12"; empty: the file as a whole
    std::string text;  // what was found and what was expected

    file_error(std::string where, std::string what_is_wrong) : place(std::move(where)), text(std::move(what_is_wrong))
    {
    }
    const char *what() const noexcept override
    {
        return text.c_str();
    }
};

#endif
